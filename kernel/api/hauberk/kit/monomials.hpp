#pragma once
/// Monomials of a truncated polynomial, and which of them multiply to which: tables that exist at compile
/// time only.

#include <array>
#include <cstddef>
#include <utility>

namespace hauberk::kit {

/// Monomials in `variables` unknowns up to the degree `order`, by degree: first 1, then the unknowns.
template <int variables, int order>
struct Monomials {
  using Exponents = std::array<int, variables>;

  static constexpr std::size_t count = [] {
    std::size_t c = 1;  // binomial(variables + order, order)
    for (int k = 1; k <= order; ++k) c = c * (variables + k) / k;
    return c;
  }();

  static constexpr int degree(const Exponents& e)
  {
    int sum = 0;
    for (const int x : e) sum += x;
    return sum;
  }

  static constexpr std::array<Exponents, count> all = [] {
    std::array<Exponents, count> list{};
    std::size_t filled = 1;
    // Each monomial follows from one of the degree below by an unknown that is not before its last.
    for (std::size_t from = 0; filled < count; ++from) {
      int last = 0;
      for (int k = 0; k < variables; ++k)
        if (list[from][k] > 0) last = k;
      for (int k = last; k < variables && filled < count; ++k) {
        list[filled] = list[from];
        ++list[filled++][k];
      }
    }
    return list;
  }();

  static constexpr std::size_t index(const Exponents& e)
  {
    std::size_t k = 0;
    while (k + 1 < count && all[k] != e) ++k;
    return k;
  }

  /// e! = e_1! e_2! ...: a derivative is the coefficient times it.
  static constexpr std::array<double, count> factorial = [] {
    std::array<double, count> list{};
    for (std::size_t k = 0; k < count; ++k) {
      list[k] = 1.0;
      for (const int e : all[k])
        for (int j = 2; j <= e; ++j) list[k] *= j;
    }
    return list;
  }();

  /// Place of the unknown i, of i and j, ... : where d/dx_i, d^2/dx_i dx_j, ... stand.
  template <class... Unknowns>
  static constexpr std::size_t place(Unknowns... unknown)
  {
    Exponents e{};
    (++e[unknown], ...);
    return index(e);
  }
};

struct MonomialPair {
  std::size_t a, b;
};

/// The pairs whose product is monomial k, of degree at least least_a and least_b; for a square, a <= b only.
template <int variables, int order, std::size_t k, int least_a, int least_b, bool ordered>
struct MonomialPairs {
  using M = Monomials<variables, order>;

  static constexpr bool fits(std::size_t a, std::size_t b)
  {
    if (ordered && a > b) return false;
    if (M::degree(M::all[a]) < least_a || M::degree(M::all[b]) < least_b) return false;
    for (int i = 0; i < variables; ++i)
      if (M::all[a][i] + M::all[b][i] != M::all[k][i]) return false;
    return true;
  }
  static constexpr std::size_t count = [] {
    std::size_t n = 0;
    for (std::size_t a = 0; a <= k; ++a)
      for (std::size_t b = 0; b <= k; ++b) n += fits(a, b) ? 1 : 0;
    return n;
  }();
  static constexpr std::array<MonomialPair, count> pairs = [] {
    std::array<MonomialPair, count> list{};
    std::size_t n = 0;
    for (std::size_t a = 0; a <= k; ++a)
      for (std::size_t b = 0; b <= k; ++b)
        if (fits(a, b)) list[n++] = {a, b};
    return list;
  }();
};

}  // namespace hauberk::kit
