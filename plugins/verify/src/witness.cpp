#include "witness.hpp"

#include "balance.hpp"
#include "links.hpp"
#include "neighbours.hpp"
#include "separation.hpp"
#include "surface.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

constexpr double largest_stretch = 1e3;  ///< singular value of F that no limit is beyond
constexpr double same_place = 1e-9;      ///< L
/// Of an unbounded value: it must have grown with the strain, to this part of it at least.
constexpr double grown = 1e-2;
constexpr int most_looks = 300;  ///< at pairs that balls do not keep apart, for one piece of a motion
constexpr int samples = 33;      ///< of a piece that takes more
constexpr int most_halvings = 30;
/// How closely pairs with a solid are enclosed, over their size.
constexpr double width_of_looks = 1e-10;

Vec3 own_displacement(const Scene& scene, const MovedState& s, std::size_t k)
{
  return s.places[k].position - s.macro.deformation() * scene.elements[k].rest.position;
}

/// Smallest separation of two placed elements is above `needed`.
bool apart(const Element& a, const Place& at, const Element& b, const Place& other, double needed)
{
  for (const Primitive& p : a.tori)
    for (const Primitive& q : b.tori) {
      const Primitive x = placed(p, at), y = placed(q, other);
      if ((x.place.position - y.place.position).norm() - reach(x) - reach(y) > needed) continue;
      if (separation_bound(x, y) > needed) continue;
      if (!(enclosed_separation(x, y, width_of_looks * (reach(x) + reach(y)), needed).least > needed))
        return false;
    }
  return true;
}

/// Surfaces of two placed elements intersect, or touch.
bool meet(const Element& a, const Place& at, const Element& b, const Place& other)
{
  for (const Primitive& p : a.tori)
    for (const Primitive& q : b.tori) {
      const Primitive x = placed(p, at), y = placed(q, other);
      if (separation_bound(x, y) <= 0.0 && separation(x, y) <= 0.0) return true;
    }
  return false;
}

/// One piece of a motion.
class Piece {
 public:
  Piece(const Scene& scene, const MovedState& from, const MovedState& to)
      : scene_(scene), from_(from), dF_(to.macro.deformation() - from.macro.deformation())
  {
    dmacro_ = to.macro.values - from.macro.values;
    for (std::size_t k = 0; k < from.places.size(); ++k) {
      u_.push_back(own_displacement(scene, from, k));
      du_.push_back(own_displacement(scene, to, k) - u_.back());
      turn_.emplace_back(Mat3(to.places[k].rotation * from.places[k].rotation.transpose()));
    }
  }

  /// Whether surfaces intersect at one of a few times.
  bool meets_somewhere()
  {
    for (int k = 0; k < samples; ++k) {
      images_ = 0.0;
      if (around(static_cast<double>(k) / (samples - 1), 0.0) == Motion::meets) return true;
    }
    return false;
  }

  Motion over(double from, double to, int halvings)
  {
    const double half = 0.5 * (to - from);
    switch (around(from + half, half)) {
      case Motion::free:
        return Motion::free;
      case Motion::meets:
        return Motion::meets;
      case Motion::undecided:
        break;
    }
    if (halvings >= most_halvings || looks_ > most_looks || images_ > most_images_of_piece())
      return Motion::undecided;
    const Motion first = over(from, from + half, halvings + 1);
    return first == Motion::free ? over(from + half, to, halvings + 1) : first;
  }

 private:
  MovedState at(double t) const
  {
    MovedState s = from_;
    s.macro.values += t * dmacro_;
    const Mat3 F = s.macro.deformation();
    for (std::size_t k = 0; k < s.places.size(); ++k) {
      s.places[k].position = F * scene_.elements[k].rest.position + u_[k] + t * du_[k];
      s.places[k].rotation =
          Eigen::AngleAxisd(t * turn_[k].angle(), turn_[k].axis()) * from_.places[k].rotation;
    }
    return s;
  }

  /// Free for all times within `half` of t, or intersecting at t, or neither is known.
  Motion around(double t, double half)
  {
    const MovedState s = at(t);
    const Mat3 F = s.macro.deformation();
    const double relative = half * Eigen::JacobiSVD<Mat3>(dF_ * F.inverse()).singularValues()[0];
    if (!(relative < 0.5)) return Motion::undecided;
    // Pairs whose origins are farther apart than this keep away: |F (X_i - X_j - T)| is their distance up to
    // the difference of u.
    double own = 0.0, change = 0.0, reaches = 0.0, turning = 0.0,
           least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < u_.size(); ++k) {
      own = std::max(own, 2.0 * (u_[k] + t * du_[k]).norm());
      change = std::max(change, 2.0 * du_[k].norm());
      reaches = std::max(reaches, 2.0 * scene_.elements[k].reach);
      turning = std::max(turning, 2.0 * std::abs(turn_[k].angle()) * scene_.elements[k].reach);
      least = std::min(least, 2.0 * scene_.elements[k].reach);
    }
    const double far = (reaches + relative * own + half * (change + turning)) / (1.0 - relative);
    const double margin = std::max(0.0, far - least);
    const double images = images_near(scene_, s.places, F, margin);
    images_ += images;
    if (!(images <= most_images(u_.size()) && images_ <= most_images_of_piece())) return Motion::undecided;
    Motion out = Motion::free;
    for (const Neighbour& pair : neighbours(scene_, s.places, F, margin)) {
      const std::size_t i = pair.first, j = pair.second;
      const Element &a = scene_.elements[i], &b = scene_.elements[j];
      Place other = s.places[j];
      other.position += translation(scene_, F, pair.image);
      const Vec3 rest = a.rest.position - b.rest.position - translation(scene_, Mat3::Identity(), pair.image);
      const double comes =
          half * ((dF_ * rest + du_[i] - du_[j]).norm() + std::abs(turn_[i].angle()) * a.reach +
                  std::abs(turn_[j].angle()) * b.reach);
      if ((s.places[i].position - other.position).norm() - a.reach - b.reach > comes) continue;
      if (half > 0.0 && ++looks_ > most_looks) return Motion::undecided;
      if (apart(a, s.places[i], b, other, comes)) continue;
      if (meet(a, s.places[i], b, other)) return Motion::meets;
      out = Motion::undecided;
    }
    return out;
  }

  /// Likewise a bound of what is looked at, of pairs that are far apart, too.
  double most_images_of_piece() const { return 20.0 * most_images(u_.size()); }

  const Scene& scene_;
  const MovedState& from_;
  Mat3 dF_;
  Macros dmacro_;
  std::vector<Vec3> u_, du_;
  std::vector<Eigen::AngleAxisd> turn_;
  int looks_ = 0;
  double images_ = 0.0;  ///< of elements that were looked at
};

MovedState rest_state(const Scene& scene, const Macro& like)
{
  MovedState out{like, {}};
  out.macro.values.setZero();
  for (const Element& element : scene.elements) out.places.push_back(element.rest);
  return out;
}

bool same_state(const Scene& scene, const MovedState& a, const MovedState& b)
{
  double off = (a.macro.values - b.macro.values).cwiseAbs().maxCoeff();
  for (std::size_t k = 0; k < a.places.size(); ++k)
    off = std::max({off, (a.places[k].position - b.places[k].position).norm() / scene.length,
                    (a.places[k].rotation - b.places[k].rotation).cwiseAbs().maxCoeff()});
  return off <= same_place;
}

/// The last state is past the bound, on the side of the load, and of an unbounded one with the value.
void check_end(const Limit& limit, const MovedState& last, Sentences& problems)
{
  const Eigen::Vector3d stretch = Eigen::JacobiSVD<Mat3>(last.macro.deformation()).singularValues();
  if (!(stretch[0] > largest_stretch || stretch[2] < 1.0 / largest_stretch)) {
    problems.push_back(
        fmt::format("the witness ends at singular values of F of {:.3g} and {:.3g}, within {:g}", stretch[2],
                    stretch[0], largest_stretch));
    return;
  }
  const double along =
      (is_positive(limit) ? 1.0 : -1.0) * load(limit).dot(last.macro.values) / load(limit).norm();
  if (limit.status == "unbounded" && !(along > grown * stretch[0]))
    problems.push_back(
        fmt::format("the witness ends with {:.3g} along the load, which is not unbounded", along));
}

}  // namespace

Motion motion(const Scene& scene, const MovedState& from, const MovedState& to)
{
  Piece piece(scene, from, to);
  const Motion out = piece.over(0.0, 1.0, 0);
  return out == Motion::undecided && piece.meets_somewhere() ? Motion::meets : out;
}

void check_witness(const Scene& scene, const Limit& limit, Sentences& problems, Sentences& found,
                   std::vector<std::size_t>& undecided)
{
  if (limit.witness.empty()) {
    problems.emplace_back("no witness is given");
    return;
  }
  if (is_bent(limit.load)) {
    problems.emplace_back("witnesses of bending are not known to this check");
    return;
  }
  for (std::size_t k = 0; k < limit.witness.size(); ++k) {
    if (limit.witness[k].places.size() == scene.elements.size()) continue;
    problems.push_back(fmt::format("witness state {} has {} poses for {} elements", k,
                                   limit.witness[k].places.size(), scene.elements.size()));
    return;
  }
  if (!same_state(scene, limit.witness.front(), rest_state(scene, limit.witness.front().macro)))
    problems.emplace_back("the witness does not begin at rest");
  for (std::size_t k = 0; k < limit.witness.size(); ++k) {
    const Eigen::SelfAdjointEigenSolver<Mat3> F(limit.witness[k].macro.deformation());
    if (F.eigenvalues()[0] > 0.0) continue;
    problems.push_back(fmt::format("witness state {}: F is not positive definite", k));
    return;
  }
  const auto links_of = [&](const MovedState& s) { return links(scene, s.places, s.macro.deformation()); };
  const auto at_rest = links_of(limit.witness.front());
  for (std::size_t k = 1; k < limit.witness.size(); ++k) {
    const std::string changed = difference(at_rest, links_of(limit.witness[k]));
    if (!changed.empty()) problems.push_back(fmt::format("witness state {}: {}", k, changed));
    const Motion way = motion(scene, limit.witness[k - 1], limit.witness[k]);
    if (way == Motion::meets)
      problems.push_back(fmt::format("between witness states {} and {} surfaces intersect", k - 1, k));
    if (way == Motion::undecided) undecided.push_back(k);
  }
  check_end(limit, limit.witness.back(), problems);
  const std::size_t pieces = limit.witness.size() - 1;
  found.push_back(fmt::format("a motion of {} pieces past every bound", pieces) +
                  (undecided.empty()
                       ? ", free of intersection"
                       : fmt::format(", {} of them shown to be free of intersection, the others at {} "
                                     "times each",
                                     pieces - undecided.size(), samples)));
}

}  // namespace hauberk::verification
