#include "limits/place_index.hpp"
#include "limits/symmetry.hpp"
#include "numerics/decompositions.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

std::span<const double> span_of(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

std::optional<Vector> transformed_macro(const Model& m, const Mat3& O, const Vector& macro)
{
  Vector out = Vector::Zero(macro.size());
  if (!m.load->transform(O, span_of(macro), {out.data(), static_cast<std::size_t>(out.size())}))
    return std::nullopt;
  return out;
}

/// Element coordinates that bring an element (rest position X, image translation T) to x: Gauss-Newton from
/// e, which needs one step where the load case is affine. Null if it does not lead there.
std::optional<Vector> coordinates_at(const Model& m, const Vector& macro, const Vec3& X, const Vec3& T,
                                     const Vec3& x, Vector e)
{
  constexpr int most_steps = 20;
  const Eigen::Index nc = m.coordinate_count;
  PositionMap map;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_steps; ++k) {
    m.load->position(span_of(macro), span_of(e), X, T, map);
    const Eigen::Matrix<double, 3, Eigen::Dynamic> J = map.J.middleCols(m.macro_count, nc);
    const Vector step = least_squares(J, x - map.x);
    // Steps fall to what rounding leaves; there they stop falling.
    if (!(step.norm() < 0.5 * last) && step.norm() < symmetry_tolerance(x)) break;
    last = step.norm();
    e += step;
  }
  m.load->position(span_of(macro), span_of(e), X, T, map);
  // What the scene's own inexactness may leave where coordinates cannot follow it, amplified by the strain.
  constexpr double strained = 10.0;
  if (!((x - map.x).norm() <= strained * symmetry_tolerance(x))) return std::nullopt;
  return e;
}

/// The factor s with t(after) . M x = s t(before) . x for all macroscopic x, if there is one: +1 or -1.
std::optional<double> value_factor(const Model& m, const Mat3& O, const Direction& before,
                                   const Direction& after)
{
  constexpr double rounding = 1e-9;
  Vector from = Vector::Zero(m.macro_count), to = from, carried = from;
  m.load->load(before, {from.data(), static_cast<std::size_t>(from.size())});
  m.load->load(after, {to.data(), static_cast<std::size_t>(to.size())});
  for (Eigen::Index k = 0; k < from.size(); ++k) {
    const std::optional<Vector> unit = transformed_macro(m, O, Vector::Unit(from.size(), k));
    if (!unit) return std::nullopt;
    carried[k] = to.dot(*unit);
  }
  for (const double factor : {1.0, -1.0}) {
    if ((carried - factor * from).norm() <= rounding * from.norm()) return factor;
  }
  return std::nullopt;
}

std::optional<Direction> carried_angle(const Mat3& O, const Direction& direction)
{
  constexpr double rounding = 1e-9;
  const Vec3 n = O * Vec3(std::cos(direction.theta()), std::sin(direction.theta()), 0.0);
  if (std::abs(n.z()) > rounding) return std::nullopt;
  double angle = std::atan2(n.y(), n.x()) / degree;
  // Rounding must not make 180 degrees of 0.
  if (angle < -rounding) angle += 180.0;
  if (angle > 180.0 - rounding) angle -= 180.0;
  return Direction::at_degrees(angle);
}

}  // namespace

SceneSymmetry inverse(const Model& m, const SceneSymmetry& g)
{
  // O X_i + t = X_j + T gives X_i - O^T T = O^T X_j - O^T t, and O Q_i = Q_j S gives O^T Q_j = Q_i S^-1.
  const LatticeCoordinates lattice(m);
  SceneSymmetry out;
  out.O = g.O.transpose();
  out.t = -(out.O * g.t);
  out.to.resize(g.to.size());
  out.image.resize(g.to.size());
  out.local.resize(g.to.size());
  for (std::size_t i = 0; i < g.to.size(); ++i) {
    const std::size_t j = g.to[i];
    out.to[j] = static_cast<int>(i);
    out.image[j] = lattice.nearest(-(out.O * m.translation(g.image[i])));
    out.local[j] = g.local[i].transpose();
  }
  return out;
}

std::optional<State> transformed(const Model& m, const SceneSymmetry& g, const State& s)
{
  std::optional<Vector> macro = transformed_macro(m, g.O, s.macro);
  if (!macro) return std::nullopt;
  State out = s;
  out.macro = std::move(*macro);
  const Eigen::Index nc = m.coordinate_count;
  const Vector none = Vector::Zero(nc);
  PositionMap origin, moved;
  m.load->position(span_of(out.macro), span_of(none), Vec3::Zero(), Vec3::Zero(), origin);
  m.load->position(span_of(out.macro), span_of(none), g.t, Vec3::Zero(), moved);
  const Vec3 shift = moved.x - origin.x;
  for (int i = 0; i < m.element_count(); ++i) {
    const std::size_t k = i;
    const std::size_t j = g.to[k];
    const Vec3 x = g.O * image_pose(m, s, i, {}).position + shift;
    // On a rolled sheet elements that slid far are beyond the reach of Newton's method from zero, or a turn
    // further; there coordinates are displacements along it, which turn with the scene.
    Vector near = none;
    if (m.load->bends()) {
      Vec3 displaced = Vec3::Zero();
      displaced.head(nc) = s.e.segment(i * nc, nc);
      near = (g.O * displaced).head(nc);
    }
    const std::optional<Vector> e =
        coordinates_at(m, out.macro, m.rest[j].position, m.translation(g.image[k]), x, std::move(near));
    if (!e) return std::nullopt;
    out.e.segment(g.to[k] * nc, nc) = *e;
    out.rotation[j] = g.O * s.rotation[k] * g.local[k].transpose();
  }
  return out;
}

std::optional<LimitTask> transformed(const Model& m, const SceneSymmetry& g, const LimitTask& task)
{
  LimitTask out = task;
  if (task.direction.is_angle()) {
    const std::optional<Direction> direction = carried_angle(g.O, task.direction);
    if (!direction) return std::nullopt;
    out.direction = *direction;
  } else {
    const std::span<const double> d = task.direction.components();
    const Vector components = Eigen::Map<const Vector>(d.data(), static_cast<Eigen::Index>(d.size()));
    if (components.size() != m.macro_count) return std::nullopt;
    const std::optional<Vector> carried = transformed_macro(m, g.O, components);
    if (!carried) return std::nullopt;
    out.direction = Direction::along(span_of(*carried));
  }
  const std::optional<double> factor = value_factor(m, g.O, task.direction, out.direction);
  if (!factor) return std::nullopt;
  if (*factor < 0.0) out.sense = task.sense == Sense::positive ? Sense::negative : Sense::positive;
  return out;
}

}  // namespace hauberk
