#pragma once
/// Truncated Taylor arithmetic: a value with its first and second derivatives in n variables.
///
/// A formula written once, on a scalar type, yields its value on double and its exact derivatives on a jet.

#include <array>
#include <cmath>
#include <cstddef>

namespace hauberk {

/// f(x) = v + g . x + 1/2 x^T h x + O(x^3). `order` 1 carries no h; h is the lower triangle, row by row.
template <int n, int order>
struct Jet {
  static_assert(order == 1 || order == 2);
  static constexpr std::size_t size = n;
  static constexpr std::size_t pairs = order == 2 ? size * (size + 1) / 2 : 0;

  double v = 0.0;
  std::array<double, size> g{};
  std::array<double, pairs> h{};

  Jet() = default;
  Jet(double value) : v(value) {}  // NOLINT: constants mix with jets

  /// The variable x_k at the value `value`.
  static Jet variable(double value, int k)
  {
    Jet x(value);
    x.g[k] = 1.0;
    return x;
  }
  static constexpr std::size_t at(std::size_t row, std::size_t column)
  {
    return row >= column ? row * (row + 1) / 2 + column : at(column, row);
  }

  Jet& operator+=(const Jet& b)
  {
    v += b.v;
    for (std::size_t k = 0; k < size; ++k) g[k] += b.g[k];
    for (std::size_t k = 0; k < pairs; ++k) h[k] += b.h[k];
    return *this;
  }
  Jet& operator-=(const Jet& b)
  {
    v -= b.v;
    for (std::size_t k = 0; k < size; ++k) g[k] -= b.g[k];
    for (std::size_t k = 0; k < pairs; ++k) h[k] -= b.h[k];
    return *this;
  }
  Jet& operator*=(double b)
  {
    v *= b;
    for (double& x : g) x *= b;
    for (double& x : h) x *= b;
    return *this;
  }
};

template <int n, int order>
Jet<n, order> operator+(Jet<n, order> a, const Jet<n, order>& b)
{
  return a += b;
}
template <int n, int order>
Jet<n, order> operator-(Jet<n, order> a, const Jet<n, order>& b)
{
  return a -= b;
}
template <int n, int order>
Jet<n, order> operator-(Jet<n, order> a)
{
  return a *= -1.0;
}
template <int n, int order>
Jet<n, order> operator+(Jet<n, order> a, double b)
{
  a.v += b;
  return a;
}
template <int n, int order>
Jet<n, order> operator+(double b, Jet<n, order> a)
{
  a.v += b;
  return a;
}
template <int n, int order>
Jet<n, order> operator-(Jet<n, order> a, double b)
{
  a.v -= b;
  return a;
}
template <int n, int order>
Jet<n, order> operator-(double b, Jet<n, order> a)
{
  a *= -1.0;
  a.v += b;
  return a;
}
template <int n, int order>
Jet<n, order> operator*(Jet<n, order> a, double b)
{
  return a *= b;
}
template <int n, int order>
Jet<n, order> operator*(double b, Jet<n, order> a)
{
  return a *= b;
}

/// (a b)_i = a_i b + a b_i,  (a b)_ij = a_ij b + a b_ij + a_i b_j + a_j b_i.
template <int n, int order>
Jet<n, order> operator*(const Jet<n, order>& a, const Jet<n, order>& b)
{
  Jet<n, order> p(a.v * b.v);
  for (std::size_t i = 0; i < p.size; ++i) p.g[i] = a.g[i] * b.v + a.v * b.g[i];
  if constexpr (order == 2) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < p.size; ++i) {
      for (std::size_t j = 0; j <= i; ++j, ++k) {
        p.h[k] = a.h[k] * b.v + a.v * b.h[k] + a.g[i] * b.g[j] + a.g[j] * b.g[i];
      }
    }
  }
  return p;
}

/// f(x) from f, f' and f'' at x.v: (f(x))_i = f' x_i,  (f(x))_ij = f' x_ij + f'' x_i x_j.
template <int n, int order>
Jet<n, order> chain_rule(const Jet<n, order>& x, double f, double df, double ddf)
{
  Jet<n, order> y(f);
  for (std::size_t i = 0; i < y.size; ++i) y.g[i] = df * x.g[i];
  if constexpr (order == 2) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < y.size; ++i) {
      for (std::size_t j = 0; j <= i; ++j, ++k) y.h[k] = df * x.h[k] + ddf * x.g[i] * x.g[j];
    }
  }
  return y;
}

template <int n, int order>
Jet<n, order> sin(const Jet<n, order>& x)
{
  const double s = std::sin(x.v), c = std::cos(x.v);
  return chain_rule(x, s, c, -s);
}
template <int n, int order>
Jet<n, order> cos(const Jet<n, order>& x)
{
  const double s = std::sin(x.v), c = std::cos(x.v);
  return chain_rule(x, c, -s, -c);
}
template <int n, int order>
Jet<n, order> sqrt(const Jet<n, order>& x)
{
  const double r = std::sqrt(x.v);
  return chain_rule(x, r, 0.5 / r, -0.25 / (r * x.v));
}
template <int n, int order>
Jet<n, order> log(const Jet<n, order>& x)
{
  return chain_rule(x, std::log(x.v), 1.0 / x.v, -1.0 / (x.v * x.v));
}
template <int n, int order>
Jet<n, order> inverse(const Jet<n, order>& x)
{
  const double i = 1.0 / x.v;
  return chain_rule(x, i, -i * i, 2.0 * i * i * i);
}

inline double inverse(double x) { return 1.0 / x; }

inline double value_of(double x) { return x; }
template <int n, int order>
double value_of(const Jet<n, order>& x)
{
  return x.v;
}

}  // namespace hauberk
