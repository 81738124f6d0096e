#include "balance.hpp"

#include "kinematics.hpp"
#include "neighbours.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

/// (c^2, s^2, c s) of the direction.
Vec3 products(double direction_deg)
{
  const double theta = direction_deg * std::numbers::pi / 180.0;
  const double c = std::cos(theta), s = std::sin(theta);
  return {c * c, s * s, c * s};
}

void add_wall(Vector& residual, const Scene& scene, const Contact& contact)
{
  const double f = contact.force * contact.normal.z() * scene.length;
  residual[first_of(scene, contact.elements[0]) + 2] -= f;
  for (std::size_t k = 0; k < scene.elements.size(); ++k)
    residual[first_of(scene, static_cast<int>(k)) + 2] += f / static_cast<double>(scene.elements.size());
}

void add_contact(Vector& residual, const Scene& scene, const Setting& setting, const MovedState& state,
                 const Contact& contact)
{
  for (std::size_t side = 0; side < 2; ++side) {
    const int k = contact.elements[side];
    const Image image = side == 0 ? Image{} : contact.image;
    const Vec3 force = (side == 0 ? -1.0 : 1.0) * contact.force * contact.normal;
    const PositionDerivatives d = derivatives(scene, setting, state, k, image);
    const Vec3 origin = state.places[k].position + translation(scene, state.macro.deformation(), image);
    residual.head(macros(scene)).noalias() += scene.length * (d.macro.transpose() * force);
    residual.segment<3>(first_of(scene, k)) += scene.length * d.own.transpose() * force;
    residual.segment<3>(first_of(scene, k) + 3) += (contact.points[side] - origin).cross(force);
  }
}

/// Weights of the components in the Frobenius norm: off-diagonal ones stand twice in the matrix, but C of A
/// x^2 + B y^2 + C x y is twice the off-diagonal one.
Macros weights(Load load)
{
  if (load == Load::strip) return Macros::Ones(2);
  if (load == Load::solid) return (Macros(6) << 1.0, 1.0, 1.0, 2.0, 2.0, 2.0).finished();
  return Vec3(1.0, 1.0, load == Load::paraboloid ? 0.5 : 2.0);
}

}  // namespace

Macros load(const Limit& limit)
{
  const std::string& measure = limit.measure;
  if (limit.direction) {
    if (measure != "metric") throw Malformed("the measure \"" + measure + "\" is not one of a direction");
    const Macros d =
        *limit.direction / limit.direction->cwiseAbs().maxCoeff();  // squares neither vanish nor overflow
    const Macros dual = weights(limit.load).cwiseProduct(d);
    return dual / std::sqrt(dual.dot(d));
  }
  const Vec3 d = products(limit.direction_deg);
  if (limit.load == Load::solid && measure == "tensor")
    return (Macros(6) << d.x(), d.y(), 0.0, 0.0, 0.0, 2.0 * d.z()).finished();
  if (limit.load == Load::strain && measure == "tensor") return Vec3(d.x(), d.y(), 2.0 * d.z());
  if (limit.load == Load::strain && measure == "equation_12") return Vec3(d / d.squaredNorm());
  if (limit.load == Load::paraboloid && measure == "normal_curvature") return Vec3(2.0 * d);
  if (limit.load == Load::strip && measure == "roll_curvature") return Eigen::Vector2d(0.0, d.y());
  if (limit.load == Load::roll && measure == "roll_curvature") return Vec3(d.x(), d.y(), 2.0 * d.z());
  throw Malformed("the measure \"" + measure + "\" is not known to this check");
}

double metric_norm(Load load, const Macros& components)
{
  return std::sqrt(weights(load).cwiseProduct(components).dot(components));
}

double value(const Limit& limit, const Macro& macro) { return load(limit).dot(macro.values); }

double line_stretch(double direction_deg, const Macro& macro)
{
  const double theta = direction_deg * std::numbers::pi / 180.0;
  return (macro.deformation() * Vec3(std::cos(theta), std::sin(theta), 0.0)).norm() - 1.0;
}

bool is_positive(const Limit& limit)
{
  return limit.sense == "stretch" || limit.sense == "up" || limit.sense == "along";
}

Macros driving_load(const Limit& limit, double length)
{
  const Macros t = load(limit);
  Macros out = is_positive(limit) ? t : Macros(-t);
  if (limit.finite_target) out -= scaled(*limit.macro, length) / *limit.finite_target;
  return out;
}

Vector left_over(const Scene& scene, const Setting& setting, const Limit& limit)
{
  const MovedState state{*limit.macro, limit.poses};
  Vector residual = Vector::Zero(unknowns(scene));
  residual.head(macros(scene)) = driving_load(limit, scene.length);
  for (const Contact& contact : limit.contacts) {
    if (contact.wall.empty())
      add_contact(residual, scene, setting, state, contact);
    else
      add_wall(residual, scene, contact);
  }
  return residual;
}

Vector reactions(const Scene& scene, const Setting& setting, const Limit& limit)
{
  const HeldComponents components = held_components(scene, setting);
  if (components.names.empty()) return Vector(0);
  const Vector left = left_over(scene, setting, limit).head(macros(scene));
  return (is_positive(limit) ? 1.0 : -1.0) * components.coefficients.colPivHouseholderQr().solve(left);
}

double imbalance(const Scene& scene, const Setting& setting, const Limit& limit)
{
  return free_part(held(scene, setting), left_over(scene, setting, limit)).cwiseAbs().maxCoeff() /
         load(limit).norm();
}

}  // namespace hauberk::verification
