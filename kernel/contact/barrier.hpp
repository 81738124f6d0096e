#pragma once
/// Clamped barriers, one per dimension of the set they are summed or integrated over. (The published contact
/// has its own, of squared gaps: published.hpp.)

#include <cmath>

namespace hauberk {

/// Value and first two derivatives of a barrier with respect to the gap.
struct BarrierValue {
  double b = 0.0, db = 0.0, ddb = 0.0;
};

/// Barrier of a gap g in (0, g_hat), zero beyond, twice continuously differentiable at g_hat, x = g/g_hat:
///
///   dimension 0 (sum over points):     b = -(1 - x)^2 ln x          (clamped log, Li et al. 2020)
///   dimension 1 (integral over a line): b = x^(-1/2) (1 - x)^3
///   dimension 2 (over a surface):       b = x^(-1)   (1 - x)^3
///
/// Contact `nearest` and `mesh` take dimension 0, `arc` dimension 1 on one circle, curve or ribbon, and
/// dimension 2 on surfaces and pairs of curves (formulation.hpp).
///
/// Near a regular contact the gap is g0 + s^2/(2 r), and each of the three, summed or integrated, grows like
/// ln(1/g0) and pushes with a force proportional to 1/g0. So all three are barriers in energy, their gaps
/// fall in proportion to the stiffness, and one stage schedule serves them all.
///
/// b has no unit, db that of 1/g and ddb that of 1/g^2. At x = 1/4 the third has b = 27/16; the second 27/32.
///
/// g must be positive: below zero dimensions 0 and 1 give not-a-number, and dimension 2 a finite, negative b.
/// Callers skip such gaps; their smallest gap tells that the state is not admissible.
template <int dimension>
BarrierValue barrier(double g, double g_hat)
{
  BarrierValue v;
  const double x = g / g_hat;
  if (x >= 1.0) return v;
  const double y = 1.0 - x;
  if constexpr (dimension == 0) {
    const double l = std::log(x);
    v.b = -y * y * l;
    v.db = (2.0 * y * l - y * y / x) / g_hat;
    v.ddb = (-2.0 * l + 4.0 * y / x + y * y / (x * x)) / (g_hat * g_hat);
  } else if constexpr (dimension == 1) {
    const double q = 1.0 / std::sqrt(x);
    v.b = q * y * y * y;
    v.db = -q * y * y * (0.5 * y / x + 3.0) / g_hat;
    v.ddb = q * y * (0.75 * y * y / (x * x) + 3.0 * y / x + 6.0) / (g_hat * g_hat);
  } else {
    const double q = 1.0 / x;
    v.b = q * y * y * y;
    v.db = -q * y * y * (y * q + 3.0) / g_hat;
    v.ddb = q * y * (2.0 * y * y * q * q + 6.0 * y * q + 6.0) / (g_hat * g_hat);
  }
  return v;
}

}  // namespace hauberk
