#pragma once
/// Bounds of a chart's derivatives over panels, from a table that intervals certify.

#include <hauberk/kit/author.hpp>

namespace hauberk::kit {

/// A number over a cell to first order: c + a s + b t within r. Of the higher terms even powers of s and t
/// count as a half and a half of either sign.
struct Affine {
  double c, a, b, r;

  explicit Affine(const OverCell& x) : c(x.p.c[0]), a(x.p.c[1]), b(x.p.c[2]), r(x.r)
  {
    using M = OverCell::Polynomial::M;
    for (std::size_t k = 3; k < M::count; ++k) {
      const bool even = M::all[k][0] % 2 == 0 && M::all[k][1] % 2 == 0;
      if (even) c += 0.5 * x.p.c[k];
      r += (even ? 0.5 : 1.0) * std::abs(x.p.c[k]);
    }
  }
};

/// A vector over a cell: x + u s + v t within `off`, |s| <= 1, |t| <= 1.
struct VectorRange {
  Vec3 x, u, v;
  double off;

  VectorRange(const Affine& p, const Affine& q, const Affine& r)
      : x(p.c, q.c, r.c), u(p.a, q.a, r.a), v(p.b, q.b, r.b), off(std::hypot(p.r, q.r, r.r))
  {
  }
  VectorRange(const OverCell& p, const OverCell& q, const OverCell& r)
      : VectorRange(Affine(p), Affine(q), Affine(r))
  {
  }
};

/// The longest vector over the cell: length is a convex function, so that it is largest at a corner.
inline double longest(const VectorRange& a)
{
  const Vec3 p = a.x + a.u, q = a.x - a.u;
  const double square = std::max(std::max((p + a.v).squaredNorm(), (p - a.v).squaredNorm()),
                                 std::max((q + a.v).squaredNorm(), (q - a.v).squaredNorm()));
  return (std::sqrt(square) + a.off) * (1.0 + 1e-14);
}

inline ProbeBounds larger(const ProbeBounds& a, const ProbeBounds& b)
{
  return {std::max(a.u, b.u),     std::max(a.v, b.v),     std::max(a.uu, b.uu),
          std::max(a.uv, b.uv),   std::max(a.vv, b.vv),   std::max(a.uuu, b.uuu),
          std::max(a.uuv, b.uuv), std::max(a.uvv, b.uvv), std::max(a.vvv, b.vvv)};
}

/// Bounds over the table's cells, and of |x| over all of them.
///
/// The chart is evaluated on Taylor models over parts of cells, so that bounds over a part are off by the
/// square of its size. Where second derivatives of a chart jump it has no bounded third ones.
template <class Chart>
class ChartBounds {
 public:
  static constexpr int cells = 8, parts = 4, dimension = Chart::dimension;

  explicit ChartBounds(const double* q)
  {
    constexpr double half = std::numbers::pi / (cells * parts);
    const int rows = dimension == 1 ? 1 : cells * parts;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < cells * parts; ++i) {
        ProbeBounds& cell = cell_[j / parts][i / parts];
        cell = larger(cell, part(q, (2 * i + 1) * half, (2 * j + 1) * half, half));
      }
  }

  /// Over |u - at_u| <= half_u, |v - at_v| <= half_v.
  ProbeBounds over(double at_u, double at_v, double half_u, double half_v) const
  {
    const Span u(at_u, half_u), v = dimension == 1 ? Span{} : Span(at_v, half_v);
    ProbeBounds b;
    for (int j = 0; j < v.count; ++j)
      for (int i = 0; i < u.count; ++i) b = larger(b, cell_[(v.first + j) % cells][(u.first + i) % cells]);
    return b;
  }

  double largest_distance() const { return farthest_; }

 private:
  /// The cells that an interval of angles meets, from `first` on around the circle.
  struct Span {
    int first = 0, count = 1;

    Span() = default;
    Span(double center, double half)
    {
      constexpr double rounding = 1e-9, per_radian = cells / (2.0 * std::numbers::pi);
      const double from = std::floor((center - half) * per_radian - rounding);
      const double to = std::floor((center + half) * per_radian + rounding);
      count = to - from >= cells - 1 ? cells : static_cast<int>(to - from) + 1;
      first = static_cast<int>(from - cells * std::floor(from / cells));
    }
  };

  ProbeBounds part(const double* q, double u, double v, double half)
  {
    const auto x = Chart::template jet<3>(turn_range(u, half, false), turn_range(v, half, true), q);
    const auto over = [&](auto... k) {
      return longest({x[0].derivative(k...), x[1].derivative(k...), x[2].derivative(k...)});
    };
    farthest_ = std::max(farthest_, over());
    if constexpr (dimension == 1) return {.u = over(0), .uu = over(0, 0), .uuu = over(0, 0, 0)};
    constexpr double unknown = std::numeric_limits<double>::infinity();
    ProbeBounds b{over(0), over(1), over(0, 0), over(0, 1), over(1, 1), unknown, unknown, unknown, unknown};
    if constexpr (dimension == 2 && !Chart::jumps)
      b.uuu = over(0, 0, 0), b.uuv = over(0, 0, 1), b.uvv = over(0, 1, 1), b.vvv = over(1, 1, 1);
    return b;
  }

  std::array<std::array<ProbeBounds, cells>, dimension == 1 ? 1 : cells> cell_{};
  double farthest_ = 0.0;
};

}  // namespace hauberk::kit
