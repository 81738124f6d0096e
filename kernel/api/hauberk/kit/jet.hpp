#pragma once
/// Truncated Taylor polynomials: a formula written once, on a scalar type, gives its value on double, exact
/// derivatives on Jet<double>, and enclosures of derivatives over a box on Jet<Interval> and over a cell of
/// coordinates on Jet<TaylorModel>.

#include <hauberk/kit/interval.hpp>
#include <hauberk/kit/monomials.hpp>

#include <type_traits>

namespace hauberk::kit {

/// f(x + h) = sum over monomials m up to `order` of c[m] h^m; derivatives are c[m] m!.
///
/// Of intervals and Taylor models c[m] m! encloses the derivative at each point of the box. Where abs, min,
/// max or clamp is undecided on it, coefficients are hulls of those of both branches, which is an enclosure
/// of the derivatives of a field as far as they are continuous, and of the one-sided ones where they jump.
template <class S, int variables, int order>
struct Jet {
  using M = Monomials<variables, order>;
  static constexpr std::size_t size = M::count;
  static constexpr bool exact = std::is_same_v<S, double>;
  using Powers = std::array<S, order + 1>;

  std::array<S, size> c{};

  Jet() = default;
  Jet(double value) { c[0] = value; }  // NOLINT: constants mix with jets
  explicit Jet(const S& value) requires(!exact) { c[0] = value; }

  /// The unknown k at `value`.
  static Jet variable(const S& value, int k)
  {
    Jet x;
    x.c[0] = value;
    x.c[1 + k] = 1.0;
    return x;
  }

  bool is_constant() const requires(exact)
  {
    for (std::size_t k = 1; k < size; ++k)
      if (c[k] != 0.0) return false;
    return true;
  }
  const S& value() const { return c[0]; }
  const S& slope(int k) const { return c[1 + k]; }
  /// The derivative by the unknowns named, for instance (0, 0, 2).
  template <class... Unknowns>
  S derivative(Unknowns... unknown) const
  {
    const std::size_t m = M::place(unknown...);
    return c[m] * M::factorial[m];
  }

  friend Jet operator-(const Jet& a)
  {
    return each([&](std::size_t k) { return -a.c[k]; });
  }
  friend Jet operator+(const Jet& a, const Jet& b)
  {
    return each([&](std::size_t k) { return a.c[k] + b.c[k]; });
  }
  friend Jet operator-(const Jet& a, const Jet& b)
  {
    return each([&](std::size_t k) { return a.c[k] - b.c[k]; });
  }
  friend Jet operator*(const Jet& a, const Jet& b)
  {
    // Sizes are constants where derivatives by coordinates are taken.
    if constexpr (exact) {
      if (b.is_constant()) return a * b.c[0];
      if (a.is_constant()) return b * a.c[0];
    }
    return product<0, 0>(a, b);
  }
  friend Jet operator/(const Jet& a, const Jet& b)
  {
    if constexpr (exact)
      if (b.is_constant()) return a * (1.0 / b.c[0]);
    return product<0, 0>(a, inverse(b));
  }

  friend Jet operator+(Jet a, double b)
  {
    a.c[0] = a.c[0] + b;
    return a;
  }
  friend Jet operator+(double a, const Jet& b) { return b + a; }
  friend Jet operator-(const Jet& a, double b) { return a + (-b); }
  friend Jet operator-(double a, const Jet& b) { return -b + a; }
  friend Jet operator*(const Jet& a, double b)
  {
    return each([&](std::size_t k) { return a.c[k] * b; });
  }
  friend Jet operator*(double a, const Jet& b) { return b * a; }
  friend Jet operator/(const Jet& a, double b)
  {
    return each([&](std::size_t k) { return a.c[k] / b; });
  }
  friend Jet operator/(double a, const Jet& b) { return a * inverse(b); }
  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }
  Jet& operator*=(const Jet& b) { return *this = *this * b; }
  Jet& operator/=(const Jet& b) { return *this = *this / b; }

  friend Jet square(const Jet& a) { return square_from<0>(a); }

  friend Jet sqrt(const Jet& a)
  {
    using std::sqrt;
    Powers f;
    f[0] = sqrt(a.c[0]);
    if constexpr (order >= 1) {
      const S by = 1.0 / f[0], by2 = squared(by);
      f[1] = by * 0.5;
      if constexpr (order >= 2) f[2] = by * by2 * -0.125;
      if constexpr (order >= 3) f[3] = by * squared(by2) * 0.0625;
      if constexpr (order >= 4) f[4] = by * by2 * squared(by2) * (-5.0 / 128.0);
    }
    return compose(a, f);
  }

  friend Jet inverse(const Jet& a)
  {
    Powers f;
    f[0] = 1.0 / a.c[0];
    for (int k = 1; k <= order; ++k) f[k] = -f[k - 1] * f[0];
    return compose(a, f);
  }

  friend Jet exp(const Jet& a)
  {
    using std::exp;
    Powers f;
    f[0] = exp(a.c[0]);
    for (int k = 1; k <= order; ++k) f[k] = f[k - 1] / static_cast<double>(k);
    return compose(a, f);
  }

  /// a^p with p constant; derivatives whose factor p (p - 1) ... vanishes are 0, also at a = 0.
  friend Jet pow(const Jet& a, double p)
  {
    using std::pow;
    Powers f;
    double binomial = 1.0;
    for (int k = 0; k <= order; ++k) {
      f[k] = binomial == 0.0 ? S(0.0) : pow(a.c[0], p - k) * binomial;
      binomial *= (p - k) / (k + 1);
    }
    return compose(a, f);
  }

  friend Jet abs(const Jet& a)
  {
    if constexpr (exact)
      return a.c[0] < 0.0 ? -a : a;
    else {
      if (lower(a.c[0]) >= 0.0) return a;
      if (upper(a.c[0]) <= 0.0) return -a;
      return hulls(a, -a, magnitude_range(a.c[0]));
    }
  }
  friend Jet max(const Jet& a, const Jet& b)
  {
    if constexpr (exact)
      return a.c[0] < b.c[0] ? b : a;
    else {
      const S apart = a.c[0] - b.c[0];
      if (lower(apart) >= 0.0) return a;
      if (upper(apart) <= 0.0) return b;
      return hulls(a, b, larger(a.c[0], b.c[0]));
    }
  }
  friend Jet min(const Jet& a, const Jet& b)
  {
    if constexpr (exact)
      return b.c[0] < a.c[0] ? b : a;
    else {
      const S apart = a.c[0] - b.c[0];
      if (upper(apart) <= 0.0) return a;
      if (lower(apart) >= 0.0) return b;
      return hulls(a, b, smaller(a.c[0], b.c[0]));
    }
  }
  friend Jet clamp(const Jet& x, const Jet& low, const Jet& high) { return min(max(x, low), high); }

  /// The root of a^2 + b^2, whose slope is at most those of a and b: |a|/h and |b|/h never exceed 1.
  friend Jet hypot(const Jet& a, const Jet& b)
  {
    Jet h = sqrt(square(a) + square(b));
    if constexpr (std::is_same_v<S, Interval> && order >= 1) {
      const Interval unit{-1.0, 1.0};
      const Interval x = intersect(unit, a.c[0] / h.c[0]), y = intersect(unit, b.c[0] / h.c[0]);
      for (int k = 1; k <= variables; ++k) h.c[k] = intersect(x * a.c[k] + y * b.c[k], h.c[k]);
    }
    return h;
  }

  /// sum of f[k] (a - a_0)^k: f of a, from f's Taylor coefficients at a_0.
  static Jet compose(const Jet& a, const Powers& f)
  {
    Jet r;
    r.c[0] = f[0];
    if constexpr (order >= 1)
      for (std::size_t k = 1; k < size; ++k) r.c[k] = a.c[k] * f[1];
    if constexpr (order >= 2) {
      const Jet second = square_from<1>(a);
      add_from<2>(r, second, f[2]);
      if constexpr (order >= 3) add_from<3>(r, product<2, 1>(second, a), f[3]);
      if constexpr (order >= 4) add_from<4>(r, square_from<2>(second), f[4]);
    }
    static_assert(order <= 4);
    return r;
  }

  /// The product of a's part of degree at least least_a and b's of at least least_b.
  template <int least_a, int least_b>
  static Jet product(const Jet& a, const Jet& b)
  {
    Jet r;
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      ((r.c[k] = coefficient<MonomialPairs<variables, order, k, least_a, least_b, false>>(a, b)), ...);
    }
    (std::make_index_sequence<size>{});
    return r;
  }
  /// The square of a's part of degree at least `least`.
  template <int least>
  static Jet square_from(const Jet& a)
  {
    Jet r;
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      ((r.c[k] = square_coefficient<MonomialPairs<variables, order, k, least, least, true>>(a)), ...);
    }
    (std::make_index_sequence<size>{});
    return r;
  }

 private:
  // Functions of S under names that this class's friends do not hide.
  static S squared(const S& x) { return square(x); }
  static S magnitude_range(const S& x) { return abs(x); }
  static S larger(const S& x, const S& y) { return max(x, y); }
  static S smaller(const S& x, const S& y) { return min(x, y); }

  template <class F>
  static Jet each(const F& f)
  {
    Jet r;
    [&]<std::size_t... k>(std::index_sequence<k...>) { ((r.c[k] = f(k)), ...); }
    (std::make_index_sequence<size>{});
    return r;
  }
  template <int degree>
  static void add_from(Jet& r, const Jet& a, const S& factor)
  {
    for (std::size_t k = Monomials<variables, degree - 1>::count; k < size; ++k)
      r.c[k] = r.c[k] + a.c[k] * factor;
  }
  static Jet hulls(const Jet& a, const Jet& b, const S& value)
  {
    Jet r = each([&](std::size_t k) { return hull(a.c[k], b.c[k]); });
    r.c[0] = value;
    return r;
  }
  template <class Pairs>
  static S coefficient(const Jet& a, const Jet& b)
  {
    return [&]<std::size_t... t>(std::index_sequence<t...>)->S
    {
      if constexpr (sizeof...(t) == 0)
        return S(0.0);
      else
        return (... + (a.c[Pairs::pairs[t].a] * b.c[Pairs::pairs[t].b]));
    }
    (std::make_index_sequence<Pairs::count>{});
  }
  template <class Pairs>
  static S square_coefficient(const Jet& a)
  {
    const auto term = [&]<std::size_t t>(std::integral_constant<std::size_t, t>) -> S {
      constexpr MonomialPair p = Pairs::pairs[t];
      if constexpr (p.a == p.b)
        return squared(a.c[p.a]);
      else
        return a.c[p.a] * a.c[p.b] * 2.0;
    };
    return [&]<std::size_t... t>(std::index_sequence<t...>)->S
    {
      if constexpr (sizeof...(t) == 0)
        return S(0.0);
      else
        return (... + term(std::integral_constant<std::size_t, t>{}));
    }
    (std::make_index_sequence<Pairs::count>{});
  }
};

}  // namespace hauberk::kit
