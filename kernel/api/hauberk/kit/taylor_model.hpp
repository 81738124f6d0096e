#pragma once
/// Taylor models over a cell of two coordinates: how a number depends on them as a polynomial, and a bound of
/// the rest. Enclosures are off by a power of the cell's size above the polynomial's degree, where intervals
/// are off by the size, since numbers that vary together stay together.
///
/// Makino and Berz 2003, Taylor models and other validated functional inclusion methods.

#include <hauberk/kit/jet.hpp>

namespace hauberk::kit {

/// p(s, t) + e, where s and t are the cell's coordinates in [-1, 1] and |e| <= r.
template <int degree>
struct TaylorModel {
  using Polynomial = Jet<double, 2, degree>;
  static constexpr int kept = degree;

  Polynomial p;
  double r = 0.0;
  double size = 0.0;  ///< at least the sum of sizes of coefficients and r; what rounding of sums is told by

  TaylorModel() = default;
  TaylorModel(double value) : size(std::abs(value)) { p.c[0] = value; }  // NOLINT: constants mix with models
  TaylorModel(const Polynomial& polynomial, double rest, double largest)
      : p(polynomial), r(rest), size(largest)
  {
  }

  static TaylorModel unknown()
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Polynomial(), infinity, infinity};
  }
  /// Between two bounds, whatever s and t.
  static TaylorModel between(double low, double high)
  {
    const double c = 0.5 * (low + high), largest = std::abs(low) + std::abs(high);
    return checked({Polynomial(c), std::max(high - c, c - low) + outward::ulp * largest, 2.0 * largest});
  }
  /// `x`, or unknown where it overflowed or is no number.
  static TaylorModel checked(const TaylorModel& x)
  {
    return x.r + x.size < std::numeric_limits<double>::infinity() ? x : unknown();
  }

  double center() const { return p.c[0]; }
  /// Sums of the sizes of coefficients by degree, that of degree 0 left out.
  std::array<double, degree + 1> norms() const
  {
    std::array<double, degree + 1> n{};
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      ((n[Polynomial::M::degree(Polynomial::M::all[k + 1])] += std::abs(p.c[k + 1])), ...);
    }
    (std::make_index_sequence<Polynomial::size - 1>{});
    return n;
  }
  /// How far it can be from center().
  double varies() const
  {
    double sum = 0.0;
    for (std::size_t k = 1; k < Polynomial::size; ++k) sum += std::abs(p.c[k]);
    return sum + r;
  }
  bool is_zero() const { return size == 0.0; }

  friend double lower(const TaylorModel& x)
  {
    return outward::down(x.p.c[0] - x.varies(), 0.0, 16.0 * outward::ulp);
  }
  friend double upper(const TaylorModel& x) { return -lower(-x); }
  friend double magnitude(const TaylorModel& x)
  {
    return (std::abs(x.p.c[0]) + x.varies()) * (1.0 + 16.0 * outward::ulp);
  }

  friend TaylorModel operator-(const TaylorModel& x) { return {-x.p, x.r, x.size}; }
  /// The last terms of a sum's and a product's rest bound what rounding makes of all other terms.
  friend TaylorModel operator+(const TaylorModel& x, const TaylorModel& y)
  {
    const double size = x.size + y.size;
    return {x.p + y.p, x.r + y.r + outward::ulp * size, size * (1.0 + 8.0 * outward::ulp)};
  }
  friend TaylorModel operator-(const TaylorModel& x, const TaylorModel& y) { return x + -y; }
  friend TaylorModel operator*(const TaylorModel& x, double y)
  {
    if (y == 0.0 || x.is_zero()) return {};
    const double size = x.size * std::abs(y) * (1.0 + 8.0 * outward::ulp) + outward::tiny;
    return {x.p * y, std::abs(y) * x.r + outward::ulp * size + outward::tiny, size};
  }
  friend TaylorModel operator*(const TaylorModel& x, const TaylorModel& y)
  {
    if (x.is_zero() || y.is_zero()) return {};
    const auto nx = x.norms(), ny = y.norms();
    double vx = x.r, vy = y.r;
    for (int k = 1; k <= degree; ++k) vx += nx[k], vy += ny[k];
    if (vy == 0.0) return x * y.p.c[0];
    if (vx == 0.0) return y * x.p.c[0];
    const double cx = std::abs(x.p.c[0]), cy = std::abs(y.p.c[0]);
    double rest = cx * y.r + cy * x.r + x.r * vy + (vx - x.r) * y.r;
    for (int i = 1; i <= degree; ++i)
      for (int j = degree + 1 - i; j <= degree; ++j) rest += nx[i] * ny[j];
    const double size = (cx + vx) * (cy + vy) * (1.0 + 32.0 * outward::ulp) + outward::tiny;
    return checked({x.p * y.p, rest + 16.0 * outward::ulp * size + outward::tiny, size});
  }
  friend TaylorModel operator+(TaylorModel x, double y)
  {
    x.p.c[0] += y;
    x.size = (x.size + std::abs(y)) * (1.0 + 8.0 * outward::ulp);
    x.r += outward::ulp * x.size;
    return x;
  }
  friend TaylorModel operator+(double x, const TaylorModel& y) { return y + x; }
  friend TaylorModel operator-(const TaylorModel& x, double y) { return x + -y; }
  friend TaylorModel operator-(double x, const TaylorModel& y) { return -y + x; }
  friend TaylorModel operator*(double x, const TaylorModel& y) { return y * x; }
  friend TaylorModel operator/(const TaylorModel& x, const TaylorModel& y) { return x * inverse(y); }
  friend TaylorModel operator/(const TaylorModel& x, double y) { return x * inverse(TaylorModel(y)); }
  friend TaylorModel operator/(double x, const TaylorModel& y) { return inverse(y) * x; }
  TaylorModel& operator+=(const TaylorModel& y) { return *this = *this + y; }

  /// Of what varies without a known shape, as hulls do, the range of the square is narrower than the product.
  friend TaylorModel square(const TaylorModel& x)
  {
    const TaylorModel product = x * x;
    if (!(product.r > x.r * x.r)) return product;
    const double low = lower(x), high = upper(x), far = std::max(std::abs(low), std::abs(high));
    const double near = low <= 0.0 && high >= 0.0 ? 0.0 : std::min(std::abs(low), std::abs(high));
    const TaylorModel range = between(near * near * (1.0 - outward::ulp), far * far * (1.0 + outward::ulp));
    return range.r < product.r ? range : product;
  }
  friend TaylorModel inverse(const TaylorModel& x) { return power(x, -1.0); }
  friend TaylorModel sqrt(const TaylorModel& x) { return pow(x, 0.5); }
  /// x^p, by Taylor's theorem where the next derivative is bounded, else by its range.
  friend TaylorModel pow(const TaylorModel& x, double p)
  {
    if (p == 0.0) return 1.0;
    if (p == 1.0 || (x.is_zero() && p > 0.0)) return x;
    const bool whole = p == std::floor(p);
    if (whole || lower(x) > 0.0) return power(x, p);
    const double high = upper(x);
    if (!(p > 0.0 && high >= 0.0)) return unknown();
    return between(0.0, std::pow(high, p) * (1.0 + outward::library));
  }
  friend TaylorModel exp(const TaylorModel& x)
  {
    std::array<double, degree + 2> f;
    f[0] = std::exp(x.p.c[0]);
    for (int k = 1; k <= degree; ++k) f[k] = f[k - 1] / k;
    f[degree + 1] = std::exp(upper(x)) / factorial(degree + 1);
    return expanded(x, f);
  }

  /// Anything between x and y at each place of the cell.
  friend TaylorModel hull(const TaylorModel& x, const TaylorModel& y)
  {
    const TaylorModel mean = (x + y) * 0.5;
    const double off = 0.5 * magnitude(x - y);
    return checked({mean.p, mean.r + off, mean.size + off});
  }
  friend TaylorModel abs(const TaylorModel& x)
  {
    if (lower(x) >= 0.0) return x;
    if (upper(x) <= 0.0) return -x;
    return between(0.0, std::max(upper(x), -lower(x)));
  }
  friend TaylorModel max(const TaylorModel& x, const TaylorModel& y)
  {
    const TaylorModel apart = x - y;
    if (lower(apart) >= 0.0) return x;
    if (upper(apart) <= 0.0) return y;
    return narrower((x + y + abs(apart)) * 0.5,
                    between(std::max(lower(x), lower(y)), std::max(upper(x), upper(y))));
  }
  friend TaylorModel min(const TaylorModel& x, const TaylorModel& y) { return -max(-x, -y); }
  friend TaylorModel clamp(const TaylorModel& x, const TaylorModel& low, const TaylorModel& high)
  {
    return min(max(x, low), high);
  }
  friend TaylorModel hypot(const TaylorModel& x, const TaylorModel& y) { return sqrt(square(x) + square(y)); }

 private:
  static TaylorModel narrower(const TaylorModel& x, const TaylorModel& y)
  {
    return y.varies() < x.varies() ? y : x;
  }

  static constexpr double factorial(int n) { return n <= 1 ? 1.0 : n * factorial(n - 1); }

  /// sum of f[k] (x - c)^k up to `degree`, and a rest of at most |f[degree + 1] (x - c)^(degree + 1)|.
  static TaylorModel expanded(const TaylorModel& x, const std::array<double, degree + 2>& f)
  {
    TaylorModel h = x;
    h.p.c[0] = 0.0;
    TaylorModel y = h * f[degree] + f[degree - 1];
    for (int k = degree - 2; k >= 0; --k) y = y * h + f[k];
    const double v = x.varies();
    double rest = std::abs(f[degree + 1]) * (1.0 + 1e-14);
    for (int k = 0; k <= degree; ++k) rest *= v;
    rest += 16.0 * outward::ulp * (std::abs(f[0]) + std::abs(f[1]) * v) + outward::tiny;
    y.r += rest, y.size += rest;
    return checked(y);
  }

  /// x^p of an x without 0, or of any x for a whole p that is not negative.
  static TaylorModel power(const TaylorModel& x, double p)
  {
    const double low = lower(x), high = upper(x), c = x.p.c[0];
    const bool any = p >= 0.0 && p == std::floor(p);
    if (!any && !(low > 0.0) && !(high < 0.0)) return unknown();
    std::array<double, degree + 2> f;
    double binomial = 1.0;
    f[0] = p == 0.5 ? std::sqrt(c) : p == -1.0 ? 1.0 / c : std::pow(c, p);
    for (int k = 1; k <= degree + 1; ++k) {
      binomial *= (p - (k - 1)) / k;
      if (k <= degree) f[k] = !any ? f[k - 1] * ((p - (k - 1)) / (k * c)) : binomial * raised(c, p - k);
    }
    const double exponent = p - (degree + 1), least = std::min(std::abs(low), std::abs(high));
    const double end = exponent >= 0.0 ? std::max(std::abs(low), std::abs(high)) : least;
    f[degree + 1] = binomial == 0.0 ? 0.0 : binomial * raised(end, exponent);
    const TaylorModel by_terms = expanded(x, f);
    if (!(low > 0.0) || by_terms.r <= 0.1 * std::abs(f[0])) return by_terms;
    // Of what varies by much its range is narrower, which ends at x^p of both ends.
    const double one = std::pow(low, p), other = std::pow(high, p);
    return narrower(by_terms, between(std::min(one, other) * (1.0 - outward::library),
                                      std::max(one, other) * (1.0 + outward::library)));
  }
  /// x^p; of a negative exponent, which a vanishing factor stands before, 0.
  static double raised(double x, double p)
  {
    if (p == -2.5) return 1.0 / (x * x * std::sqrt(x));
    if (p == -3.5) return 1.0 / (x * x * x * std::sqrt(x));
    if (x == 0.0 && p < 0.0) return 0.0;
    return std::pow(x, p);
  }
};

}  // namespace hauberk::kit
