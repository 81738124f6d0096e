#include "balance.hpp"

#include "kinematics.hpp"
#include "neighbours.hpp"

#include <Eigen/Geometry>

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
  residual[first_of(contact.elements[0]) + 2] -= f;
  for (std::size_t k = 0; k < scene.elements.size(); ++k)
    residual[first_of(static_cast<int>(k)) + 2] += f / static_cast<double>(scene.elements.size());
}

void add_contact(Vector& residual, const Scene& scene, const Setting& setting, const MovedState& state,
                 const Contact& contact)
{
  for (std::size_t side = 0; side < 2; ++side) {
    const int k = contact.elements[side];
    const std::array<int, 2> image = side == 0 ? std::array<int, 2>{0, 0} : contact.image;
    const Vec3 force = (side == 0 ? -1.0 : 1.0) * contact.force * contact.normal;
    const PositionDerivatives d = derivatives(scene, setting, state, k, image);
    const Vec3 origin = state.places[static_cast<std::size_t>(k)].position +
                        translation(scene, state.macro.deformation(), image);
    residual.head<3>() += scene.length * d.macro.transpose() * force;
    residual.segment<3>(first_of(k)) += scene.length * d.own.transpose() * force;
    residual.segment<3>(first_of(k) + 3) += (contact.points[side] - origin).cross(force);
  }
}

}  // namespace

Vec3 load(const Limit& limit)
{
  const std::string& measure = limit.measure;
  if (limit.direction) {
    if (measure != "metric") throw Malformed("the measure \"" + measure + "\" is not one of a direction");
    const Vec3 m(1.0, 1.0, limit.load == Load::strain ? 2.0 : 0.5);
    const Vec3 d =
        *limit.direction / limit.direction->cwiseAbs().maxCoeff();  // squares neither vanish nor overflow
    const Vec3 dual = m.cwiseProduct(d);
    return dual / std::sqrt(dual.dot(d));
  }
  const Vec3 d = products(limit.direction_deg);
  if (measure == "tensor") return {d.x(), d.y(), 2.0 * d.z()};
  if (measure == "paper") return d / d.squaredNorm();
  if (measure == "normal_curvature") return 2.0 * d;
  throw Malformed("the measure \"" + measure + "\" is not known to this check");
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

Vec3 driving_load(const Limit& limit, double length)
{
  const Vec3 t = load(limit);
  Vec3 out = is_positive(limit) ? t : Vec3(-t);
  if (limit.finite_target) out -= scaled(*limit.macro, length) / *limit.finite_target;
  return out;
}

double imbalance(const Scene& scene, const Setting& setting, const Limit& limit)
{
  const MovedState state{*limit.macro, limit.poses};
  Vector residual = Vector::Zero(unknowns(scene));
  residual.head<3>() = driving_load(limit, scene.length);
  for (const Contact& contact : limit.contacts) {
    if (contact.wall.empty())
      add_contact(residual, scene, setting, state, contact);
    else
      add_wall(residual, scene, contact);
  }
  return free_part(held(scene, setting), residual).cwiseAbs().maxCoeff() / load(limit).norm();
}

}  // namespace hauberk::verification
