#include "capsule.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {

ProbeDerivatives Capsule::probe(const ProbeAngles& at) const
{
  const Vec3 axis(0.0, 0.0, sizes_[0]);
  ProbeDerivatives d;
  d.x = at.cos_u * axis;
  d.u = -at.sin_u * axis;
  d.uu = -at.cos_u * axis;
  d.v = d.uv = d.vv = Vec3::Zero();
  return d;
}

ProbeBounds Capsule::probe_bounds(double at_u, double /*at_v*/, double half_u, double /*half_v*/) const
{
  const double h = sizes_[0];
  const double sine = std::min(1.0, std::abs(std::sin(at_u)) + half_u);
  const double cosine = std::min(1.0, std::abs(std::cos(at_u)) + half_u);
  ProbeBounds b;
  b.u = b.uuu = h * sine;
  b.uu = h * cosine;
  return b;
}

Vec3 Capsule::surface_point(const ProbeAngles& at) const
{
  // Twice the height that the cosine has: what is beyond 1 is the sine of the latitude e on a cap, whose
  // cosine is sqrt(1 - e^2) = |sin v| sqrt(2 (1 + |e|)/(1 + |cos v|)).
  const double height = 2.0 * at.cos_v, middle = std::clamp(height, -1.0, 1.0), e = height - middle;
  const double across =
      std::clamp(at.sin_v * std::sqrt(2.0 * (1.0 + std::abs(e)) / (1.0 + std::abs(at.cos_v))), -1.0, 1.0);
  return {sizes_[1] * across * at.cos_u, sizes_[1] * across * at.sin_u, sizes_[0] * middle + sizes_[1] * e};
}

Vec3 Capsule::from_segment(const Vec3& x) const
{
  return {x.x(), x.y(), x.z() - std::clamp(x.z(), -sizes_[0], sizes_[0])};
}

SolidDistance Capsule::distance(const Vec3& x) const
{
  const Vec3 d = from_segment(x);
  const double length = std::max(d.norm(), 1e-300);
  SolidDistance out;
  out.distance = out.at_least = length - sizes_[1];
  out.normal = length > 1e-300 ? Vec3(d / length) : Vec3(Vec3::UnitX());
  const double across = std::hypot(out.normal.x(), out.normal.y());
  out.along =
      across > 0.0 ? Vec3(-out.normal.y() / across, out.normal.x() / across, 0.0) : Vec3(Vec3::UnitX());
  out.bend_along = 1.0 / length;
  out.bend_across = std::abs(x.z()) > sizes_[0] ? 1.0 / length : 0.0;
  return out;
}

void Capsule::distance_sizes(const Vec3& x, std::span<double> out) const
{
  const Vec3 d = from_segment(x);
  out[0] = -std::abs(d.z()) / std::max(d.norm(), 1e-300);
  out[1] = -1.0;
}

void Capsule::probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const
{
  out[0] = n.z() * at.cos_u;
  out[1] = -1.0;
}

}  // namespace hauberk
