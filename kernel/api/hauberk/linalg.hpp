#pragma once
/// The few linear-algebra names that may cross a plugin boundary.
///
/// Only types whose size and alignment do not depend on vector flags are used there: 3-vectors and
/// 3x3 matrices of double (24 and 72 bytes, never over-aligned) and spans of double.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <numbers>
#include <span>

namespace hauberk {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Radians per degree.
inline constexpr double degree = std::numbers::pi / 180.0;

/// Cross-product matrix: skew(a) b = a x b.
inline Mat3 skew(const Vec3& a)
{
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Rotation matrix exp(skew(w)) (Rodrigues), accurate for small |w|. Thread safe.
Mat3 rotation_exp(const Vec3& w);

/// How the rotation turns as w changes, the left Jacobian of SO(3):
///
///     d exp(skew(w)) = skew(J dw) exp(skew(w)),
///     J = I + (1 - cos a)/a^2 W + (a - sin a)/a^3 W^2,   W = skew(w), a = |w|
///
/// (Chirikjian, Stochastic Models, Information Theory, and Lie Groups 2, 2011, page 40; Sola, Deray and
/// Atchuthan 2018, equation (145)). Regular for a < 2 pi. Accurate for small |w|. Thread safe.
Mat3 rotation_exp_jacobian(const Vec3& w);

/// The shortest w with rotation_exp(w) = Q, |w| <= pi; of half a turn, one of the two. Accurate for small
/// turns and for those near half a turn. Thread safe.
Vec3 rotation_log(const Mat3& Q);

/// Shortest rotation that takes e_z to the unit vector `axis`; for axis = -e_z, half a turn about e_x.
Mat3 rotation_from_z(const Vec3& axis);

/// Whether the orthogonal matrix O maps the plane z = 0 to itself, up to rounding: then O_zz = +1 or -1.
inline bool keeps_plane(const Mat3& O)
{
  constexpr double rounding = 1e-9;
  return O.topRightCorner<2, 1>().norm() <= rounding && O.bottomLeftCorner<1, 2>().norm() <= rounding;
}

}  // namespace hauberk
