#include "balance.hpp"

#include "neighbours.hpp"

#include <Eigen/Geometry>

#include <algorithm>
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

/// n . dF/d(exx, eyy, exy) Y.
Vec3 strain_derivative(const Vec3& n, const Vec3& Y)
{
  return {n.x() * Y.x(), n.y() * Y.y(), n.x() * Y.y() + n.y() * Y.x()};
}

struct Residual {
  Vec3 strain = Vec3::Zero();
  std::vector<Vec3> force, torque;

  double largest(bool with_z) const
  {
    double out = strain.cwiseAbs().maxCoeff();
    for (const Vec3& f : force)
      out = std::max({out, std::abs(f.x()), std::abs(f.y()), with_z ? std::abs(f.z()) : 0.0});
    for (const Vec3& t : torque) out = std::max(out, t.cwiseAbs().maxCoeff());
    return out;
  }
};

void add_wall(Residual& residual, const Contact& contact, double L)
{
  const double f = contact.force * contact.normal.z() * L;
  residual.force[static_cast<std::size_t>(contact.elements[0])].z() -= f;
  for (Vec3& force : residual.force) force.z() += f / static_cast<double>(residual.force.size());
}

void add_contact(Residual& residual, const Scene& scene, const Limit& limit, const Contact& contact)
{
  const auto a = static_cast<std::size_t>(contact.elements[0]),
             b = static_cast<std::size_t>(contact.elements[1]);
  const Vec3 force = contact.force * contact.normal;
  const Vec3 T = translation(scene, Mat3::Identity(), contact.image);
  const Vec3 FT = translation(scene, limit.macro->deformation(), contact.image);
  residual.force[a] -= force * scene.length;
  residual.force[b] += force * scene.length;
  residual.torque[a] -= (contact.points[0] - limit.poses[a].position).cross(force);
  residual.torque[b] += (contact.points[1] - limit.poses[b].position - FT).cross(force);
  residual.strain +=
      strain_derivative(force, scene.elements[b].rest.position + T - scene.elements[a].rest.position);
}

}  // namespace

Vec3 load(const std::string& measure, double direction_deg)
{
  const Vec3 d = products(direction_deg);
  if (measure == "tensor") return {d.x(), d.y(), 2.0 * d.z()};
  if (measure == "paper") return d / d.squaredNorm();
  throw Malformed("the measure \"" + measure + "\" is not known to this check");
}

double value(const std::string& measure, double direction_deg, const Strain& macro)
{
  return load(measure, direction_deg).dot(Vec3(macro.exx, macro.eyy, macro.exy));
}

double line_stretch(double direction_deg, const Strain& macro)
{
  const double theta = direction_deg * std::numbers::pi / 180.0;
  return (macro.deformation() * Vec3(std::cos(theta), std::sin(theta), 0.0)).norm() - 1.0;
}

Vec3 driving_load(const Limit& limit)
{
  const Vec3 t = load(limit.measure, limit.direction_deg);
  Vec3 out = limit.sense == "compress" ? Vec3(-t) : t;
  if (limit.finite_target)
    out -= Vec3(limit.macro->exx, limit.macro->eyy, limit.macro->exy) / *limit.finite_target;
  return out;
}

double imbalance(const Scene& scene, const Setting& setting, const Limit& limit)
{
  const Vec3 t = load(limit.measure, limit.direction_deg);
  Residual residual;
  residual.strain = driving_load(limit);
  residual.force.assign(limit.poses.size(), Vec3::Zero());
  residual.torque.assign(limit.poses.size(), Vec3::Zero());
  for (const Contact& contact : limit.contacts) {
    if (contact.wall.empty())
      add_contact(residual, scene, limit, contact);
    else
      add_wall(residual, contact, scene.length);
  }
  return residual.largest(setting.half_height > 0.0) / t.norm();
}

}  // namespace hauberk::verification
