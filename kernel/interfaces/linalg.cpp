#include <hauberk/linalg.hpp>

#include <cmath>

namespace hauberk {
namespace {

/// sin(a) / a. The quotient is accurate to rounding for every a > 0, so only 0 needs its limit.
double sinc(double a) { return a == 0.0 ? 1.0 : std::sin(a) / a; }

}  // namespace

Mat3 rotation_exp(const Vec3& w)
{
  // exp(W) = I + sinc(a) W + (1 - cos a)/a^2 W^2, a = |w|; 1 - cos a = 2 sin^2(a/2) avoids the cancellation.
  const double angle = w.norm();
  const double half = sinc(0.5 * angle);
  const Mat3 W = skew(w);
  return Mat3::Identity() + sinc(angle) * W + (0.5 * half * half) * (W * W);
}

Mat3 rotation_exp_jacobian(const Vec3& w)
{
  // (a - sin a)/a^3 cancels: below 1/2 its series 1/3! - a^2/5! + a^4/7! - ... is exact to rounding.
  constexpr double small = 0.5;
  constexpr int terms = 8;
  const double angle = w.norm();
  const double half = sinc(0.5 * angle);
  double third = 0.0;
  if (angle < small) {
    double term = 1.0 / 6.0;
    for (int k = 1; k <= terms; ++k) {
      third += term;
      term *= -angle * angle / ((2.0 * k + 2.0) * (2.0 * k + 3.0));
    }
  } else {
    third = (angle - std::sin(angle)) / (angle * angle * angle);
  }
  const Mat3 W = skew(w);
  return Mat3::Identity() + (0.5 * half * half) * W + third * (W * W);
}

Vec3 rotation_log(const Mat3& Q)
{
  // Of the unit quaternion (cos a/2, n sin a/2): Eigen divides by its largest component, so that neither
  // small turns nor those near half a turn lose digits.
  const Eigen::Quaterniond q(Q);
  const double sine = q.vec().norm(), cosine = q.w();
  if (sine == 0.0) return Vec3::Zero();
  return (2.0 * std::atan2(std::copysign(sine, cosine), std::abs(cosine)) / sine) * q.vec();
}

Mat3 rotation_from_z(const Vec3& axis)
{
  // Rodrigues about e_z x axis = (-y, x, 0), with (1 - cos)/sin^2 = 1/(1 + z). Where z < 0 the equal form
  // (1 - z)/(x^2 + y^2) is taken, because 1 + z cancels there.
  const double x = axis.x();
  const double y = axis.y();
  const double z = axis.z();
  const double across = x * x + y * y;
  if (z < 0.0 && across < 1e-300) return Vec3(1.0, -1.0, -1.0).asDiagonal();
  const double k = z >= 0.0 ? 1.0 / (1.0 + z) : (1.0 - z) / across;
  Mat3 m;
  m << 1.0 - k * x * x, -k * x * y, x,  //
      -k * x * y, 1.0 - k * y * y, y,   //
      -x, -y, z;
  return m;
}

}  // namespace hauberk
