#include "motion/track.hpp"

#include "model/near_pairs.hpp"
#include "numerics/interrupted.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk {

Track::Track(const Model& model, const State& state, const Vector& step, int k, const Image& im)
    : m(&model), from(&state), dy(&step), element(k), image(im)
{
  const int nc = m->coordinate_count, o = m->offset(k);
  w = step.segment<3>(o + nc);
  const std::size_t n = nc, nm = m->macro_count;
  acceleration =
      m->load->acceleration_bound({state.macro.data(), nm}, {step.data(), nm}, {state.e.data() + k * nc, n},
                                  {step.data() + o, n}, m->rest[k].position, m->translation(image));
  at(0.0, pose, velocity);
}

void Track::at(double s, Pose& there, Vec3& moving) const
{
  const int nc = m->coordinate_count, nm = m->macro_count, o = m->offset(element);
  std::array<double, max_macro> macro{};
  std::array<double, max_coordinates> e{};
  for (int k = 0; k < nm; ++k) macro[k] = from->macro[k] + s * (*dy)[k];
  for (int k = 0; k < nc; ++k) e[k] = from->e[element * nc + k] + s * (*dy)[o + k];
  PositionMap map;
  const std::size_t i = element;
  m->load->position({macro.data(), static_cast<std::size_t>(nm)}, {e.data(), static_cast<std::size_t>(nc)},
                    m->rest[i].position, m->translation(image), map);
  there = {map.x, rotation_exp(s * w) * from->rotation[i]};
  moving = map.J.leftCols(nm) * dy->head(nm) + map.J.middleCols(nm, nc) * dy->segment(o, nc);
}

double wall_step(const Model& m, const State& from, const Vector& dy, double keep)
{
  double alpha = 1.0;
  for (const LinearInequality& w : m.walls) {
    double g = w.offset, rate = 0.0;
    for (const auto& t : w.terms) {
      g += t.coefficient * from.e[t.element * m.coordinate_count + t.coordinate];
      rate += t.coefficient * dy[m.offset(t.element) + t.coordinate];
    }
    if (rate < 0.0) alpha = std::min(alpha, std::max(0.0, (1.0 - keep) * g / -rate));
  }
  return alpha;
}

namespace {

/// Margin of `near_pairs` that no pair which touches on the way exceeds, from how the lattice moves; infinite
/// where it changes by too much for that, or where what accelerates is not known to move images linearly.
///
/// With A the lattice's vectors, G = (dA/ds) A^-1 and n the image, x_ij,n = x_ij,0 - A n moves by
///   v_ij,n = v_ij,0 - G (x_ij,0 - x_ij,n) = G x_ij,n + q_i - q_j,   q_i = v_i - G x_i,
/// and what touches at some s in [0, 1] has |x_ij,n(0)| <= touching + |v_ij,n| + (a_i + a_j)/2, with a
/// the bounds of accelerations, so that
///   |x_ij,n(0)| <= (touching + |q_i - q_j| + (a_i + a_j)/2) / (1 - |G|).
/// The q of elements that keep their places in the moving lattice, however far it was stretched, differ
/// little.
double margin_of_lattice(const Model& m, const State& from, const Vector& dy, double widest)
{
  constexpr double most_change = 0.6;
  constexpr double never = std::numeric_limits<double>::infinity();
  const Track origin(m, from, dy, 0, {0, 0});
  Mat3 A = Mat3::Identity(), dA = Mat3::Zero();
  for (std::size_t k = 0; k < m.lattice.size(); ++k) {
    Image image{};
    image[k] = 1;
    const Track there(m, from, dy, 0, image);
    A.col(k) = there.pose.position - origin.pose.position;
    dA.col(k) = there.velocity - origin.velocity;
  }
  const Mat3 G = dA * A.inverse();
  const double change = G.norm();
  if (!(change <= most_change)) return never;
  Vec3 lowest = Vec3::Constant(never), highest = -lowest;
  double bend = 0.0;
  for (int i = 0; i < m.element_count(); ++i) {
    const Track t(m, from, dy, i, {0, 0});
    const Vec3 q = t.velocity - G * t.pose.position;
    lowest = lowest.cwiseMin(q);
    highest = highest.cwiseMax(q);
    bend = std::max(bend, t.acceleration);
  }
  if (bend > 0.0 && !m.load->bends()) return never;
  const double touching = 2.0 * widest + m.clearance;
  return (touching + (highest - lowest).norm() + bend) / (1.0 - change) - 2.0 * widest;
}

/// The same for a strip that bends, however much it is strained. Its vector is A at the beginning and nowhere
/// shorter than A_min. What touches at some s has images |n| A_min <= touching + |x_ij,0(s)|, so that
///   |x_ij,n(0)| <= |x_ij,0(0)| + A/A_min (touching + |x_ij,0(0)| + 2 v),
/// where v is how far the fastest element goes.
double margin_of_strip(const Model& m, const State& from, const Vector& dy, double widest)
{
  const Track origin(m, from, dy, 0, {0, 0}), image(m, from, dy, 0, {1, 0});
  const Vec3 A = image.pose.position - origin.pose.position, dA = image.velocity - origin.velocity;
  Eigen::AlignedBox3d places;
  double fastest = 0.0;
  for (int i = 0; i < m.element_count(); ++i) {
    const Track t(m, from, dy, i, {0, 0});
    places.extend(t.pose.position);
    fastest = std::max(fastest, t.velocity.norm() + 0.5 * t.acceleration);
  }
  const double shortest = std::min(A.norm(), (A + dA).norm()), spread = places.diagonal().norm();
  return spread + A.norm() / shortest * (2.0 * widest + m.clearance + spread + 2.0 * fastest);
}

/// Pairs of a periodic cell that the step may bring together.
std::vector<ElementPair> pairs_of_cell(const Model& m, const State& from, const Vector& dy,
                                       const std::function<bool()>* keep_going)
{
  double widest = 0.0;
  for (const double r : m.reach) widest = std::max(widest, r);
  if (m.load->bends()) {
    double margin = margin_of_lattice(m, from, dy, widest);
    if (!std::isfinite(margin)) margin = margin_of_strip(m, from, dy, widest);
    return near_pairs(m, from, margin * (1.0 + 1e-9), keep_going);
  }
  // x_ij(s) = F(s) X + u_ij(s), X at rest. A pair that touches at s has |x_ij(s)| <= touching, so that
  //   |X| <= (touching + |u_ij(s)|)/s_min,   |x_ij(0)| <= touching + own + |dF| |X|,
  // where u_ij is as far as elements have left their places in the deformed lattice. The smallest stretch of
  // a symmetric F is concave in F: it is least at one of the two ends.
  const State to = advanced(m, from, dy, 1.0);
  const double own = 2.0 * largest_motion(m, dy);
  const double strain = dy.head(m.macro_count).cwiseAbs().sum();
  const double smin = std::min(m.load->stretch_range(from.macro_values()).first,
                               m.load->stretch_range(to.macro_values()).first);
  const int nc = m.coordinate_count;
  Vector lowest = from.e.head(nc), highest = lowest;
  for (int k = 1; k < m.element_count(); ++k) {
    lowest = lowest.cwiseMin(from.e.segment(k * nc, nc));
    highest = highest.cwiseMax(from.e.segment(k * nc, nc));
  }
  const double touching = 2.0 * widest + m.clearance, apart = (highest - lowest).norm() + own;
  double margin = m.clearance + own + strain * (touching + apart) / std::max(smin, 1e-3);
  // Where that is wide, elements have left their places in the lattice at rest, or the lattice was stretched
  // far. Beyond rounding: what is as far as it may be is told apart later.
  if (margin > 2.0 * widest) margin = std::min(margin, margin_of_lattice(m, from, dy, widest) * (1.0 + 1e-9));
  return near_pairs(m, from, margin, keep_going);
}

/// Pairs of a patch that the step may bring together: no element goes farther than the fastest one may.
std::vector<ElementPair> pairs_of_patch(const Model& m, const State& from, const Vector& dy)
{
  double farthest = 0.0;
  for (int i = 0; i < m.element_count(); ++i) {
    const Track track(m, from, dy, i, {0, 0});
    farthest = std::max(farthest, track.velocity.norm() + 0.5 * track.acceleration);
  }
  // Beyond rounding: what is as far as it may be is told apart below.
  return near_pairs(m, from, (m.clearance + 2.0 * farthest) * (1.0 + 1e-12) + 1e-12);
}

}  // namespace

std::vector<CandidatePair> candidate_pairs(const Model& m, const State& from, const Vector& dy,
                                           const std::function<bool()>* keep_going)
{
  std::vector<CandidatePair> out;
  long looked = 0;
  for (const ElementPair& pair :
       m.lattice.empty() ? pairs_of_patch(m, from, dy) : pairs_of_cell(m, from, dy, keep_going)) {
    poll(keep_going, ++looked);
    const Track ti(m, from, dy, pair.i, {0, 0}), tj(m, from, dy, pair.j, pair.image);
    const std::size_t i = pair.i, j = pair.j;
    const double approach = (ti.velocity - tj.velocity).norm() + 0.5 * (ti.acceleration + tj.acceleration);
    if ((ti.pose.position - tj.pose.position).norm() - m.reach[i] - m.reach[j] - approach > m.clearance)
      continue;
    out.push_back({ti, tj, approach});
  }
  return out;
}

}  // namespace hauberk
