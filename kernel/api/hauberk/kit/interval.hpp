#pragma once
/// Interval arithmetic with outward rounding: results hold every value that the operands' points give.
///
/// Rounding modes stay as they are: each bound moves outward by a relative 2^-52, which is at least the
/// rounding error of one operation, and by the smallest normal number where a result can underflow.

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::kit {

/// All reals from lo to hi; bounds may be infinite and are never NaN.
struct Interval {
  double lo = 0.0, hi = 0.0;

  constexpr Interval() = default;
  constexpr Interval(double value) : lo(value), hi(value) {}  // NOLINT: constants mix with intervals
  constexpr Interval(double low, double high) : lo(low), hi(high) {}

  static constexpr Interval entire()
  {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  /// A number inside; 0 of an unbounded interval.
  double mid() const { return is_bounded() ? 0.5 * lo + 0.5 * hi : 0.0; }
  /// The largest distance from mid(), rounded up.
  double rad() const { return std::max(hi - mid(), mid() - lo) * (1.0 + 0x1p-51); }
  constexpr bool contains(double x) const { return lo <= x && x <= hi; }
  constexpr bool is_zero() const { return lo == 0.0 && hi == 0.0; }
  bool is_bounded() const { return std::isfinite(lo) && std::isfinite(hi); }
};

namespace outward {

inline constexpr double ulp = 0x1p-52;
inline constexpr double tiny = std::numeric_limits<double>::min();

/// A number below the exact result that was rounded to x: of +inf the largest finite one, of NaN -inf.
inline double down(double x, double least = 0.0, double relative = ulp)
{
  const double y = x - (std::abs(x) * relative + least);
  if (y == y) return y;
  return x > 0.0 ? std::numeric_limits<double>::max() : -std::numeric_limits<double>::infinity();
}
inline double up(double x, double least = 0.0, double relative = ulp) { return -down(-x, least, relative); }

/// What an elementary function of the library may be off by.
inline constexpr double library = 4.0 * ulp;

}  // namespace outward

inline Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }

/// A sum that underflows is exact, so that 0 + 0 stays 0.
inline Interval operator+(const Interval& a, const Interval& b)
{
  return {outward::down(a.lo + b.lo), outward::up(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a, const Interval& b)
{
  return {outward::down(a.lo - b.hi), outward::up(a.hi - b.lo)};
}

namespace outward {

/// The product of two bounds, where 0 times infinity is 0.
inline double bound_product(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }

inline Interval careful_product(const Interval& a, const Interval& b)
{
  const double p[] = {bound_product(a.lo, b.lo), bound_product(a.lo, b.hi), bound_product(a.hi, b.lo),
                      bound_product(a.hi, b.hi)};
  return {down(*std::min_element(p, p + 4), tiny), up(*std::max_element(p, p + 4), tiny)};
}

}  // namespace outward

inline Interval operator*(const Interval& a, const Interval& b)
{
  if (a.is_zero() || b.is_zero()) return {};
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  const double sum = (p + q) + (r + s);
  if (sum != sum) return outward::careful_product(a, b);
  return {outward::down(std::min(std::min(p, q), std::min(r, s)), outward::tiny),
          outward::up(std::max(std::max(p, q), std::max(r, s)), outward::tiny)};
}

/// The whole line where b holds 0.
inline Interval operator/(const Interval& a, const Interval& b)
{
  if (b.lo <= 0.0 && b.hi >= 0.0) return Interval::entire();
  if (a.is_zero()) return {};
  const Interval inverse{outward::down(1.0 / b.hi, outward::tiny), outward::up(1.0 / b.lo, outward::tiny)};
  return a * inverse;
}

inline Interval operator+(const Interval& a, double b) { return a + Interval(b); }
inline Interval operator+(double a, const Interval& b) { return Interval(a) + b; }
inline Interval operator-(const Interval& a, double b) { return a - Interval(b); }
inline Interval operator-(double a, const Interval& b) { return Interval(a) - b; }
inline Interval operator*(const Interval& a, double b) { return a * Interval(b); }
inline Interval operator*(double a, const Interval& b) { return Interval(a) * b; }
inline Interval operator/(const Interval& a, double b) { return a / Interval(b); }
inline Interval operator/(double a, const Interval& b) { return Interval(a) / b; }
inline Interval& operator+=(Interval& a, const Interval& b) { return a = a + b; }
inline Interval& operator-=(Interval& a, const Interval& b) { return a = a - b; }
inline Interval& operator*=(Interval& a, const Interval& b) { return a = a * b; }

inline Interval hull(const Interval& a, const Interval& b)
{
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
/// The common part of two enclosures of the same number; one of them where rounding leaves none.
inline Interval intersect(const Interval& a, const Interval& b)
{
  const Interval common{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  return common.lo <= common.hi ? common : a;
}
/// The largest |x|.
inline double magnitude(const Interval& a) { return std::max(std::abs(a.lo), std::abs(a.hi)); }
inline double lower(const Interval& a) { return a.lo; }
inline double upper(const Interval& a) { return a.hi; }
/// The least |x|.
inline double mignitude(const Interval& a)
{
  return a.lo <= 0.0 && a.hi >= 0.0 ? 0.0 : std::min(std::abs(a.lo), std::abs(a.hi));
}

inline Interval abs(const Interval& a) { return {mignitude(a), magnitude(a)}; }
inline Interval min(const Interval& a, const Interval& b)
{
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Interval max(const Interval& a, const Interval& b)
{
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Interval clamp(const Interval& x, const Interval& low, const Interval& high)
{
  return min(max(x, low), high);
}

inline Interval square(const Interval& a)
{
  if (a.is_zero()) return {};
  const double lo = mignitude(a), hi = magnitude(a);
  return {std::max(0.0, outward::down(lo * lo, outward::tiny)), outward::up(hi * hi, outward::tiny)};
}

/// The root of the part that is not negative; the whole line where there is none.
inline Interval sqrt(const Interval& a)
{
  if (a.hi < 0.0) return Interval::entire();
  if (a.is_zero()) return {};
  return {std::max(0.0, outward::down(std::sqrt(std::max(0.0, a.lo)))), outward::up(std::sqrt(a.hi))};
}

inline Interval exp(const Interval& a)
{
  return {std::max(0.0, outward::down(std::exp(a.lo), outward::tiny, outward::library)),
          outward::up(std::exp(a.hi), outward::tiny, outward::library)};
}

namespace outward {

/// x^p for x >= 0, with rounding; monotone in x.
inline Interval positive_power(double from, double to, double p)
{
  const double a = std::pow(from, p), b = std::pow(to, p);
  return {std::max(0.0, down(std::min(a, b), tiny, library)), up(std::max(a, b), tiny, library)};
}

}  // namespace outward

/// x^p. Of a p that is no integer, over the part of `a` that is not negative, as of sqrt().
inline Interval pow(const Interval& a, double p)
{
  if (p == 0.0) return 1.0;
  if (p == 1.0) return a;
  const bool whole = p == std::floor(p), even = whole && std::fmod(p, 2.0) == 0.0;
  if (p < 0.0 && a.lo <= 0.0 && a.hi >= 0.0 && (a.lo < 0.0 || a.hi == 0.0)) return Interval::entire();
  if (even) return outward::positive_power(mignitude(a), magnitude(a), p);
  if (!whole) {
    if (a.hi < 0.0) return Interval::entire();
    return outward::positive_power(std::max(0.0, a.lo), a.hi, p);
  }
  const auto odd = [p](double x) {
    return x < 0.0 ? -outward::positive_power(-x, -x, p) : outward::positive_power(x, x, p);
  };
  return hull(odd(a.lo), odd(a.hi));
}

/// The root of a^2 + b^2.
inline Interval hypot(const Interval& a, const Interval& b) { return sqrt(square(a) + square(b)); }

// The same names for plain numbers, so that a template finds all of them with one using-directive.
inline double square(double x) { return x * x; }
inline double magnitude(double x) { return std::abs(x); }
using std::abs;
using std::clamp;
using std::exp;
using std::hypot;
using std::max;
using std::min;
using std::pow;
using std::sqrt;

}  // namespace hauberk::kit
