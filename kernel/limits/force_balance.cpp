#include "limits/force_balance.hpp"

#include "equilibrium/gaps.hpp"
#include "numerics/decompositions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

/// How many times the rounding of coordinates a gap may be off, by all that goes into it; and the part of
/// itself by which a force may be changed at most.
constexpr double most_roundings = 100.0, most_changed = 0.1;
/// In units of the load: what forces may go on to miss it by weighs as much as a change of the tightest one
/// by its whole.
constexpr double negligible = 1e-6;
/// Relative difference of two derivatives of one gap.
constexpr double same_gap = 1e-6;

/// Adds f dg/dy of a contact: a gap opens when B's point moves along the normal and A's against it.
void add_force(const Model& m, const State& s, const ContactEnergy::Point& p, double f, Vector& sum)
{
  const int nm = m.macro_count, nc = m.coordinate_count;
  const auto push = [&](int element, const Image& image, const Vec3& point, const Vec3& force) {
    PositionMap map;
    const std::size_t k = element;
    m.load->position(s.macro_values(), {s.e.data() + element * nc, static_cast<std::size_t>(nc)},
                     m.rest[k].position, m.translation(image), map);
    sum.head(nm) += map.J.leftCols(nm).transpose() * force;
    sum.segment(m.offset(element), nc) += map.J.middleCols(nm, nc).transpose() * force;
    sum.segment<3>(m.offset(element) + nc) += (point - map.x).cross(force);
  };
  if (p.wall >= 0) {
    for (const LinearTerm& t : m.walls[p.wall].terms)
      sum[m.offset(t.element) + t.coordinate] += f * t.coefficient;
    return;
  }
  push(m.bodies[p.a].element, {0, 0}, p.contact.on_p, -f * p.contact.normal);
  push(m.bodies[p.b].element, p.image, p.contact.on_f, f * p.contact.normal);
}

/// load + sum f dg/dy.
Vector left_over(const Model& m, const State& s, const MacroLoad& load,
                 const std::vector<ContactEnergy::Point>& points, double mu)
{
  Vector left = Vector::Zero(m.dofs());
  left.head(m.macro_count) = load.pull;
  for (const ContactEnergy::Point& p : points) add_force(m, s, p, mu * p.contact.force, left);
  return left;
}

/// The gap of these bodies that has the derivative of a contact; null: there is none.
const Gap* gap_of(const std::vector<Gap>& gaps, const ContactEnergy::Point& p, const Vector& derivative)
{
  const auto found = std::find_if(gaps.begin(), gaps.end(), [&](const Gap& g) {
    return g.a == p.a && g.b == p.b && g.image == p.image &&
           (g.dy - derivative).norm() <= same_gap * derivative.norm();
  });
  return found == gaps.end() ? nullptr : &*found;
}

}  // namespace

Vector unheld(const Model& m, const Matrix& held, const Vector& forces)
{
  Vector out = free_part(m, forces);
  out.head(m.macro_count) = within(held, out.head(m.macro_count));
  return out;
}

ForceBalance force_balance(const Model& m, const State& s, const MacroLoad& load,
                           const std::vector<ContactEnergy::Point>& points, double mu)
{
  const Vector left = left_over(m, s, load, points, mu);
  ForceBalance out;
  if (load.held.cols() > 0) out.reactions = least_squares(load.held, left.head(m.macro_count));
  out.imbalance = unheld(m, load.held, left).cwiseAbs().maxCoeff();
  return out;
}

std::optional<Vector> balancing_parts(const Model& m, const State& s, const MacroLoad& load,
                                      const std::vector<ContactEnergy::Point>& points, double mu)
{
  if (m.sparse() || points.empty()) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(points.size());
  Vector rounding(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double gap = points[k].contact.gap;
    if (!(gap > 0.0)) return std::nullopt;
    rounding[k] = rounding_of_x / gap;
  }
  const Vector inexact = rounding / rounding.maxCoeff();
  // Parts are inexact_k x_k with the least |left + F x|^2 / negligible^2 + |x|^2: combinations of forces that
  // nearly cancel are no way out.
  const Eigen::Index unknowns = m.dofs();
  Matrix forces = Matrix::Zero(unknowns + count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const ContactEnergy::Point& p = points[k];
    Vector force = Vector::Zero(unknowns);
    add_force(m, s, p, mu * p.contact.force, force);
    forces.col(k).head(unknowns) = inexact[k] * unheld(m, load.held, force);
  }
  forces.bottomRows(count).diagonal().setConstant(negligible * load.pull.norm());
  Vector wanted = Vector::Zero(unknowns + count);
  wanted.head(unknowns) = -unheld(m, load.held, left_over(m, s, load, points, mu));
  const Vector parts = inexact.cwiseProduct(least_squares(forces, wanted));
  for (Eigen::Index k = 0; k < count; ++k)
    if (!(std::abs(parts[k]) <= std::min(most_changed, most_roundings * rounding[k]))) return std::nullopt;
  return parts;
}

bool change_forces(ContactEnergy& contacts, const Model& m, const State& s, Formulation formulation,
                   const Vector& parts)
{
  ContactEnergy changed = contacts;
  std::vector<Gap> gaps;
  const bool single = !traits(formulation).is_integral;
  if (single) {
    double range = 0.0;
    for (const ContactEnergy::Point& p : contacts.points) range = std::max(range, 2.0 * p.contact.gap);
    gaps = find_gaps(m, s, range, true);
  }
  for (std::size_t k = 0; k < contacts.points.size(); ++k) {
    ContactEnergy::Point& p = changed.points[k];
    const double more = parts[k] * p.contact.force;
    p.contact.force += more;
    if (p.wall >= 0 || !single) continue;
    Vector derivative = Vector::Zero(m.dofs());
    add_force(m, s, p, 1.0, derivative);
    const Gap* const gap = gap_of(gaps, p, derivative);
    if (gap == nullptr) return false;
    // dE/dp = - sum f dg/dp, where dg/d clearance = -1.
    changed.d_clearance += more;
    changed.parameters.col(m.bodies[p.a].element).head(gap->da.size()) -= more * gap->da;
    changed.parameters.col(m.bodies[p.b].element).head(gap->db.size()) -= more * gap->db;
  }
  contacts = std::move(changed);
  return true;
}

}  // namespace hauberk
