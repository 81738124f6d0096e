#include "roll.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::verification {

Vec3 rolled(const Macros& curvature, const Vec3& at)
{
  const Vec3 y(at.x(), at.y(), 0.0);
  const Vec3 towards(-(curvature[0] * y.x() + curvature[2] * y.y()),
                     -(curvature[2] * y.x() + curvature[1] * y.y()), 0.0);
  const double angle = towards.norm();
  if (!(angle > 0.0)) return at;
  const Vec3 axis = Vec3::UnitZ().cross(towards / angle);
  const Vec3 along = axis.dot(y) * axis, across = y - along;  // a helix about the axis
  const double half = std::sin(0.5 * angle);                  // 1 - cos a = 2 sin^2(a/2)
  return along + std::sin(angle) / angle * across + 2.0 * half * half / angle * axis.cross(across) +
         Eigen::AngleAxisd(angle, axis) * Vec3(0.0, 0.0, at.z());
}

Eigen::Matrix<double, 3, 6> rolled_derivatives(const Macros& curvature, const Vec3& at)
{
  Eigen::Matrix<double, 3, 6> out;
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    const double h = 1e-3 / (1.0 + (k < 3 ? at.norm() : curvature.norm()));
    const auto moved = [&](double by) {
      Macros c = curvature;
      Vec3 a = at;
      (k < 3 ? c[k] : a[k - 3]) += by;
      return rolled(c, a);
    };
    out.col(k) = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
  }
  return out;
}

namespace {

constexpr double rounding = 1e-14;

double missed(const Macros& curvature, const Vec3& x, const Vec3& at)
{
  return (x - rolled(curvature, at)).norm() / (1.0 + x.norm());
}

Vec3 newton(const Macros& curvature, const Vec3& x, Vec3 at)
{
  constexpr int most_steps = 30;
  for (int k = 0; k < most_steps && missed(curvature, x, at) > 0.1 * rounding; ++k) {
    const Mat3 J = rolled_derivatives(curvature, at).rightCols<3>();
    at += J.fullPivLu().solve(x - rolled(curvature, at));
  }
  return at;
}

}  // namespace

Vec3 unrolled(const Macros& curvature, const Vec3& x, const Vec3& rest)
{
  constexpr int directions = 8;
  constexpr double other_side = 0.5;  // of radii of curvature: where Newton's method may have gone astray
  Vec3 best = newton(curvature, x, rest);
  if (std::abs(best.z() - rest.z()) * curvature.norm() < other_side) return best;
  const auto away = [&](const Vec3& at) {
    return missed(curvature, x, at) <= rounding ? (at - rest).norm()
                                                : std::numeric_limits<double>::infinity();
  };
  const double scale = std::max(x.norm(), rest.norm());
  for (int k = 0; k < 3 * directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / directions, ring = 0.5 + 0.5 * (k / directions);
    const Vec3 start = scale * ring * Vec3(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 other = newton(curvature, x, {start.x(), start.y(), rest.z()});
    if (away(other) < away(best)) best = other;
  }
  return best;
}

}  // namespace hauberk::verification
