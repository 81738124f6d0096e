#pragma once
/// Distance from a point to a surface of revolution, reduced to its meridian half-plane.
///
/// The closest point of a surface of revolution lies in the meridian plane of the query point, so the
/// three-dimensional search collapses to a distance between a point and a plane curve: a circle (closed
/// form) or an ellipse (one safeguarded iteration in one angle).

#include "geometry/body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace hauberk {

/// Signed distance in the meridian plane and what is needed for its derivatives.
struct MeridianDistance {
  double phi = 0.0;         ///< signed distance to the surface, negative inside
  double nr = 0.0, nz = 0;  ///< gradient of phi in (rho, z): outward unit normal at the closest point
  double k = 0.0;           ///< second derivative of phi along the meridian, perpendicular to the gradient
  double c = 0.0, s = 0.0;  ///< cos v, sin v of the closest point on the profile
};

/// Closest point of the ellipse (a cos v, b sin v) to the point (x, y).
///
/// In the first quadrant the closest point is the root of
///   f(v) = (a^2 - b^2) cos v sin v - x a sin v + y b cos v,
/// with f(0) >= 0 >= f(pi/2); Halley's method on the unit vector (cos v, sin v), bracketed. No allocation,
/// thread safe. For points inside, `phi` is negative and exact as long as the point is closer to the curve
/// than to its medial axis.
MeridianDistance ellipse_distance(double a, double b, double x, double y);

/// The same for two or four points at once, to rounding, in a little more than the time for one.
template <std::size_t n>
std::array<MeridianDistance, n> ellipse_distances(double a, double b, const std::array<double, n>& x,
                                                  const std::array<double, n>& y);

/// Signed distance of the point (rho, z) of the meridian half-plane to the body's profile.
inline MeridianDistance meridian_distance(const Body& body, double rho, double z)
{
  if (body.kind != PrimitiveKind::circle_tube) {
    return ellipse_distance(body.r0, body.r1, rho - body.R, z);
  }
  const double x = rho - body.R;
  const double d = std::max(std::sqrt(x * x + z * z), 1e-300);
  return {d - body.r0, x / d, z / d, 1.0 / d, x / d, z / d};
}

/// Distance field of a body, evaluated at a point in the body's own frame. Of a solid only `phi` and `k` of
/// `m` are known, and `meridian` is the first principal direction.
struct FieldValue {
  MeridianDistance m;
  double rho = 0.0;    ///< the field's Hessian is nowhere below -1/(rho - d) within d of the point
  double doubt = 0.0;  ///< by how much the distance may be less than phi: of solids, beyond their reach
  Vec3 n;              ///< gradient of phi
  Vec3 meridian;       ///< unit, perpendicular to n in the meridian plane; curvature m.k
  Vec3 azimuth;        ///< unit, perpendicular to both; curvature k_azimuth
  double k_azimuth = 0.0;
};

/// The field of a ball: |p| - r0, whose level surfaces bend by 1/|p| in all directions. `rho` is the distance
/// from the centre, the only place where the field is not smooth.
FieldValue ball_field(double r0, const Vec3& p);

/// The field at the point p from what is known in its meridian plane.
inline FieldValue field_from_meridian(const MeridianDistance& m, double rho, const Vec3& p)
{
  FieldValue f;
  f.rho = rho;
  const double ex = p.x() / rho;
  const double ey = p.y() / rho;
  f.m = m;
  f.n = Vec3(m.nr * ex, m.nr * ey, m.nz);
  f.meridian = Vec3(-m.nz * ex, -m.nz * ey, m.nr);
  f.azimuth = Vec3(-ey, ex, 0.0);
  f.k_azimuth = m.nr / rho;
  return f;
}

/// Distance of a point from the axis; not zero.
inline double radius_of(const Vec3& p) { return std::max(std::sqrt(p.x() * p.x() + p.y() * p.y()), 1e-300); }

/// The field of a solid.
FieldValue solid_field(const Body& body, const Vec3& p);

inline FieldValue field_at(const Body& body, const Vec3& p)
{
  if (body.is_point()) return ball_field(body.r0, p);
  if (!body.is_torus() && body.solid) return solid_field(body, p);
  const double rho = radius_of(p);
  return field_from_meridian(meridian_distance(body, rho, p.z()), rho, p);
}

/// A point, and where its field goes.
struct PointField {
  const Vec3* p = nullptr;
  FieldValue* f = nullptr;
};

/// field_at() for several points, to rounding: some at a time where each takes an iteration. Thread safe.
void fields_at(const Body& body, std::span<const PointField> points);

}  // namespace hauberk
