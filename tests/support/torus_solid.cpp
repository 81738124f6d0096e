#include "torus_solid.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::test {

ProbeDerivatives TorusSolid::probe(const ProbeAngles& at) const
{
  const double R = sizes_[0], r = dimension_ == 1 ? 0.0 : sizes_[1];
  const Vec3 radial(at.cos_u, at.sin_u, 0.0), tangent(-at.sin_u, at.cos_u, 0.0), up = Vec3::UnitZ();
  const double w = R + r * at.cos_v;
  ProbeDerivatives d;
  d.x = w * radial + r * at.sin_v * up;
  d.u = w * tangent;
  d.v = r * (-at.sin_v * radial + at.cos_v * up);
  d.uu = -w * radial;
  d.uv = -r * at.sin_v * tangent;
  d.vv = -r * (at.cos_v * radial + at.sin_v * up);
  return d;
}

ProbeBounds TorusSolid::probe_bounds(double, double, double, double) const
{
  const double r = dimension_ == 1 ? 0.0 : sizes_[1], w = sizes_[0] + r;
  return {w, r, w, r, r, w, r, r, r};
}

Vec3 TorusSolid::surface_point(const ProbeAngles& at) const
{
  return TorusSolid(sizes_[0], sizes_[1], 2).probe(at).x;
}

SolidDistance TorusSolid::distance(const Vec3& x) const
{
  const double rho = std::max(std::hypot(x.x(), x.y()), 1e-300), p = rho - sizes_[0];
  const double core = std::max(std::hypot(p, x.z()), 1e-300);
  const Vec3 radial(x.x() / rho, x.y() / rho, 0.0);
  SolidDistance d;
  d.distance = d.at_least = core - sizes_[1];
  d.normal = (p / core) * radial + (x.z() / core) * Vec3::UnitZ();
  d.along = (-x.z() / core) * radial + (p / core) * Vec3::UnitZ();
  d.bend_along = 1.0 / core;
  d.bend_across = p / core / rho;
  return d;
}

SolidSmoothness TorusSolid::smoothness() const
{
  // Curvatures are 1/r and cos v/(R + r cos v). Along a geodesic at the angle a to the meridian the normal
  // curvature is cos^2 a/r + sin^2 a cos v/(R + r cos v): its change is below this.
  const double R = sizes_[0], r = sizes_[1], hole = R - r;
  return {1.0 / r, hole, 3.0 * R / (r * hole * hole)};
}

void TorusSolid::distance_sizes(const Vec3& x, std::span<double> out) const
{
  const double rho = std::max(std::hypot(x.x(), x.y()), 1e-300), p = rho - sizes_[0];
  out[0] = -p / std::max(std::hypot(p, x.z()), 1e-300);
  out[1] = -1.0;
}

void TorusSolid::probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const
{
  out[0] = n.x() * at.cos_u + n.y() * at.sin_u;
  out[1] = dimension_ == 1 ? -1.0 : at.cos_v * out[0] + n.z() * at.sin_v;
}

std::vector<std::vector<Vec3>> TorusSolid::cores() const
{
  // Inside the tube where R (1 - cos(pi/n)) < r.
  constexpr int corners = 48;
  std::vector<Vec3> core;
  for (int k = 0; k < corners; ++k) {
    const double u = 2.0 * std::numbers::pi * k / corners;
    core.emplace_back(sizes_[0] * std::cos(u), sizes_[0] * std::sin(u), 0.0);
  }
  return {core};
}

Primitive torus_solid(double R, double r, int dimension)
{
  Primitive p;
  p.name = "solid";
  p.kind = PrimitiveKind::solid;
  p.size = {R + r, r, r};
  p.solid = std::make_shared<const TorusSolid>(R, r, dimension);
  return p;
}

TorusSolidShape::TorusSolidShape(int dimension) : dimension_(dimension)
{
  for (const char* name : {"R", "r"}) parameters_.push_back({name, "length", 1.0, 1e-9, 1e9, "", true});
}

void TorusSolidShape::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  out.assign(1, torus_solid(p[0], p[1], dimension_));
}

void TorusSolidShape::do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const
{
  out.assign(1, PrimitiveJacobian((primitive_dofs + 2) * 2, 0.0));
  for (std::size_t k = 0; k < 2; ++k) out[0][(primitive_dofs + k) * 2 + k] = 1.0;
}

}  // namespace hauberk::test
