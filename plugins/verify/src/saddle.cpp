#include "saddle.hpp"

#include "balance.hpp"
#include "links.hpp"
#include "moving.hpp"
#include "neighbours.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

/// Contacts that carry less than this share of the largest force do not hold a direction.
constexpr double carries = 1e-3;
/// Difference step of the gaps' gradients: closest points are exact to 1e-14 or so.
constexpr double difference_step = 1e-5;
/// Eigenvalues of W below this (over the load's norm) are noise of differences.
constexpr double noise = 1e-4;
/// How far a state is moved along an unstable direction.
constexpr double kicks[] = {3e-3, 1e-2, 3e-2};
constexpr int most_directions = 3;
/// Least gain that counts, over the load's norm.
constexpr double least_gain = 1e-7;

/// Sum of f dg over the listed contacts, at a moved state; closest points are found again from the listed
/// ones.
Vector load_of_contacts(const Scene& scene, const Setting& setting, const Limit& limit,
                        const MovedState& state)
{
  Vector sum = Vector::Zero(unknowns(scene));
  for (const Contact& contact : limit.contacts) {
    if (contact.wall.empty())
      sum += contact.force * scene.length * row_of(scene, setting, state, contact).gradient;
  }
  return sum;
}

Matrix curvature(const Scene& scene, const Setting& setting, const Limit& limit, const MovedState& state)
{
  const Eigen::Index n = unknowns(scene);
  Matrix w(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vector e = difference_step * Vector::Unit(n, j);
    w.col(j) = (load_of_contacts(scene, setting, limit, moved(scene, setting, state, e)) -
                load_of_contacts(scene, setting, limit, moved(scene, setting, state, -e))) /
               (2.0 * difference_step);
  }
  return 0.5 * (w + w.transpose());
}

/// Orthonormal basis of the directions that keep what is held, and all gaps that carry force.
Matrix free_directions(const Scene& scene, const Setting& setting, const Limit& limit,
                       const MovedState& state)
{
  double largest = 0.0;
  for (const Contact& contact : limit.contacts) largest = std::max(largest, contact.force);
  const Eigen::Index n = unknowns(scene);
  Matrix rows = held(scene, setting);
  for (const Contact& contact : limit.contacts) {
    if (contact.force < carries * largest) continue;
    rows.conservativeResize(Eigen::NoChange, rows.cols() + 1);
    rows.col(rows.cols() - 1) = row_of(scene, setting, state, contact).gradient;
  }
  if (rows.cols() == 0) return Matrix::Identity(n, n);
  Eigen::ColPivHouseholderQR<Matrix> qr(rows);
  qr.setThreshold(1e-8);
  const Matrix q = qr.householderQ() * Matrix::Identity(n, n);
  return q.rightCols(n - qr.rank());
}

/// Smallest e with rows . e >= bounds nearest to `wanted` (Hildreth's method: one row at a time, multipliers
/// >= 0).
Vector projected(const Vector& wanted, const std::vector<GapRow>& rows, double room)
{
  constexpr int sweeps = 400;
  Vector e = wanted;
  std::vector<double> multiplier(rows.size(), 0.0);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double norm = rows[k].gradient.squaredNorm();
      if (norm == 0.0) continue;
      const double lacking = (room - rows[k].gap - rows[k].gradient.dot(e)) / norm;
      const double next = std::max(0.0, multiplier[k] + lacking);
      e += (next - multiplier[k]) * rows[k].gradient;
      change = std::max(change, std::abs(next - multiplier[k]) * std::sqrt(norm));
      multiplier[k] = next;
    }
    if (change < 1e-14) break;
  }
  return e;
}

/// What the solver maximises: load . macro, less |macro|^2/(2 T) where there is a finite target.
struct Objective {
  Macros load;
  double length = 1.0;
  double softness = 0.0;  ///< 1/T

  double value(const MovedState& state) const
  {
    const Macros macro = scaled(state.macro, length);
    return load.dot(macro) - 0.5 * softness * macro.squaredNorm();
  }
  Macros gradient(const MovedState& state) const { return load - softness * scaled(state.macro, length); }
};

/// From a kicked state to a nearby one with gaps >= 0 that is as far as a few steps go; nothing when it does
/// not get there.
std::optional<MovedState> brought_back(const Scene& scene, const Setting& setting,
                                       const std::vector<Link>& links_here, MovedState state,
                                       const Objective& objective, double kick)
{
  constexpr int steps = 12;
  constexpr double room = 1e-9;     // L, so that rounding leaves no intersection
  const double range = 4.0 * kick;  // gaps that may close on the way
  // Room made by a kick is of its square; ten times that reaches what there is within the steps.
  const double pull = kick * kick;
  const Matrix fixed = held(scene, setting);
  for (int k = 0; k < 2 * steps; ++k) {
    std::vector<GapRow> rows = all_rows(scene, setting, state, range);
    for (GapRow& row : rows) row.gradient = free_part(fixed, row.gradient);
    Vector wanted = Vector::Zero(unknowns(scene));
    // First on along the load, then only what makes room.
    if (k < steps) wanted.head(macros(scene)) = pull * objective.gradient(state) / objective.load.norm();
    const Vector e = projected(free_part(fixed, wanted), rows, room);
    if (e.cwiseAbs().maxCoeff() > 10.0 * kick) return std::nullopt;
    state = moved(scene, setting, state, e);
    if (k >= steps && e.cwiseAbs().maxCoeff() < 1e-11) break;
  }
  const auto closest =
      closest_pair(scene, state.places, state.macro.deformation(), scene.length, 0.1 * room * scene.length);
  if (closest && closest->least < setting.clearance) return std::nullopt;
  // A kick may be larger than a very thin tube is thick.
  if (!difference(links_here, links(scene, state.places, state.macro.deformation())).empty())
    return std::nullopt;
  return state;
}

}  // namespace

std::optional<Further> further_nearby(const Scene& scene, const Setting& setting, const Limit& limit)
{
  const Macros t = load(limit);
  const Objective objective{is_positive(limit) ? t : Macros(-t), scene.length,
                            limit.finite_target ? 1.0 / *limit.finite_target : 0.0};
  const MovedState here{*limit.macro, limit.poses};
  double closing = 0.0;
  for (const Contact& contact : limit.contacts) closing += contact.force * std::max(0.0, contact.gap);
  const double threshold = objective.value(here) + 2.0 * closing + least_gain * t.norm();

  const std::vector<Link> links_here = links(scene, here.places, here.macro.deformation());
  const Matrix z = free_directions(scene, setting, limit, here);
  if (z.cols() == 0) return std::nullopt;
  Matrix w = curvature(scene, setting, limit, here);
  w.diagonal().head(macros(scene)).array() -= objective.softness;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(z.transpose() * w * z);
  for (Eigen::Index k = 1; k <= std::min<Eigen::Index>(most_directions, z.cols()); ++k) {
    if (!(eigen.eigenvalues()[z.cols() - k] > noise * t.norm())) break;
    const Vector direction = z * eigen.eigenvectors().col(z.cols() - k);
    const Vector d = direction / direction.cwiseAbs().maxCoeff();
    for (const double kick : kicks)
      for (const double way : {1.0, -1.0}) {
        const auto there = brought_back(scene, setting, links_here,
                                        moved(scene, setting, here, way * kick * d), objective, kick);
        if (there && objective.value(*there) > threshold)
          return Further{objective.value(*there) - threshold, kick};
      }
  }
  return std::nullopt;
}

}  // namespace hauberk::verification
