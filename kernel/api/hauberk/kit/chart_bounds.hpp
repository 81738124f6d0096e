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
  const double length = (std::sqrt(square) + a.off) * (1.0 + 1e-14);
  return length < std::numeric_limits<double>::infinity() ? length : std::numeric_limits<double>::infinity();
}

inline ProbeBounds larger(const ProbeBounds& a, const ProbeBounds& b)
{
  return {std::max(a.u, b.u),     std::max(a.v, b.v),     std::max(a.uu, b.uu),
          std::max(a.uv, b.uv),   std::max(a.vv, b.vv),   std::max(a.uuu, b.uuu),
          std::max(a.uuv, b.uuv), std::max(a.uvv, b.uvv), std::max(a.vvv, b.vvv)};
}

/// Angles from `from` to `to`, at most a turn.
struct AngleSpan {
  double from = 0.0, to = 2.0 * std::numbers::pi;

  double center() const { return 0.5 * (from + to); }
  double half() const { return 0.5 * (to - from); }
};

/// Equal parts of a span that are at most `widest`.
inline std::vector<AngleSpan> equal_parts(const AngleSpan& span, double widest)
{
  const int count = std::max(1, static_cast<int>(std::ceil((span.to - span.from) / widest * (1.0 - 1e-12))));
  std::vector<AngleSpan> parts;
  for (int k = 0; k < count; ++k)
    parts.push_back({std::lerp(span.from, span.to, static_cast<double>(k) / count),
                     std::lerp(span.from, span.to, (k + 1.0) / count)});
  return parts;
}

/// Parts that halve towards both ends, where Taylor models cannot tell the one side of a jump from the other;
/// of each end `left_out` is left out.
inline std::vector<AngleSpan> graded_parts(const AngleSpan& span, double widest, double left_out)
{
  std::vector<AngleSpan> parts;
  for (const double side : {-1.0, 1.0}) {
    const double end = side < 0.0 ? span.from : span.to;
    for (double far = span.half(); far > left_out; far *= 0.5) {
      const double near = std::max(0.5 * far, left_out);
      const AngleSpan part = side < 0.0 ? AngleSpan{end + near, end + far} : AngleSpan{end - far, end - near};
      for (const AngleSpan& small : equal_parts(part, widest)) parts.push_back(small);
    }
  }
  return parts;
}

/// What lies between the angles `cuts`, in parts that are at most `widest`; all of the circle without them.
inline std::vector<AngleSpan> spans_between(std::vector<double> cuts, double widest)
{
  constexpr double turn_around = 2.0 * std::numbers::pi;
  for (double& cut : cuts) cut -= turn_around * std::floor(cut / turn_around);
  if (cuts.empty()) cuts.push_back(0.0);
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(cuts.front() + turn_around);
  std::vector<AngleSpan> spans;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    for (const AngleSpan& part : equal_parts({cuts[k], cuts[k + 1]}, widest)) spans.push_back(part);
  return spans;
}

/// Bounds over the table's cells.
///
/// The chart is evaluated on Taylor models over parts of cells, so that bounds over a part are off by the
/// square of its size. Cells end where second derivatives jump; what holds such a place within has no bounded
/// third ones.
template <class Chart>
class ChartBounds {
 public:
  static constexpr int dimension = Chart::dimension;

  explicit ChartBounds(const double* q)
  {
    constexpr double cell = std::numbers::pi / 4.0;
    if constexpr (dimension == 2) {
      breaks_ = Chart::breaks(q);
      v_ = spans_between(breaks_, cell);
    }
    // Of a surface of revolution one meridian tells all.
    const bool revolved = dimension == 2 && ChartDomain::of<typename Chart::Author>(q).revolved;
    u_ = revolved ? std::vector<AngleSpan>(1) : spans_between({}, cell);
    for (const AngleSpan& v : v_)
      for (const AngleSpan& u : u_) cells_.push_back(over_cell(q, revolved ? AngleSpan{0.0, 0.0} : u, v));
  }

  /// Over |u - at_u| <= half_u, |v - at_v| <= half_v.
  ProbeBounds over(double at_u, double at_v, double half_u, double half_v) const
  {
    ProbeBounds b;
    for (std::size_t j = 0; j < v_.size(); ++j) {
      if (dimension == 2 && !meet(at_v, half_v, v_[j])) continue;
      for (std::size_t i = 0; i < u_.size(); ++i)
        if (u_.size() == 1 || meet(at_u, half_u, u_[i])) b = larger(b, cells_[j * u_.size() + i]);
    }
    for (const double jump : breaks_)
      if (meet(at_v, half_v - 2.0 * rounding, {jump, jump}))
        b.uuu = b.uuv = b.uvv = b.vvv = std::numeric_limits<double>::infinity();
    return b;
  }

 private:
  static constexpr double rounding = 1e-9;  ///< of angles

  static bool meet(double at, double half, const AngleSpan& span)
  {
    constexpr double turn_around = 2.0 * std::numbers::pi;
    double apart = std::abs(at - span.center());
    if (apart > turn_around) apart -= turn_around * std::floor(apart / turn_around);
    return std::min(apart, turn_around - apart) <= half + span.half() + rounding;
  }

  /// The largest over parts of a cell. What parts leave out at places of jumps, 1e-9, is covered by a margin.
  ProbeBounds over_cell(const double* q, const AngleSpan& u, const AngleSpan& v)
  {
    constexpr double part = std::numbers::pi / 16.0;
    const bool graded = !breaks_.empty();
    const auto parts_v = dimension == 1 ? std::vector<AngleSpan>(1)
                         : graded       ? graded_parts(v, part, rounding)
                                        : equal_parts(v, part);
    ProbeBounds b;
    for (const AngleSpan& du : equal_parts(u, part))
      for (const AngleSpan& dv : parts_v) b = larger(b, over_part(q, du, dv));
    return graded ? enlarged(b, 1.0 + 1e-6) : b;
  }

  static ProbeBounds enlarged(const ProbeBounds& b, double by)
  {
    return {b.u * by,   b.v * by,   b.uu * by,  b.uv * by, b.vv * by,
            b.uuu * by, b.uuv * by, b.uvv * by, b.vvv * by};
  }

  ProbeBounds over_part(const double* q, const AngleSpan& u, const AngleSpan& v)
  {
    const auto x = Chart::template jet<3>(turn_range(u.center(), u.half(), false),
                                          turn_range(v.center(), v.half(), true), q);
    const auto over = [&](auto... k) {
      return longest({x[0].derivative(k...), x[1].derivative(k...), x[2].derivative(k...)});
    };
    if constexpr (dimension == 1) return {.u = over(0), .uu = over(0, 0), .uuu = over(0, 0, 0)};
    constexpr double unknown = std::numeric_limits<double>::infinity();
    ProbeBounds b{over(0), over(1), over(0, 0), over(0, 1), over(1, 1), unknown, unknown, unknown, unknown};
    if constexpr (dimension == 2 && !Chart::jumps)
      b.uuu = over(0, 0, 0), b.uuv = over(0, 0, 1), b.uvv = over(0, 1, 1), b.vvv = over(1, 1, 1);
    return b;
  }

  std::vector<AngleSpan> u_, v_ = std::vector<AngleSpan>(1);
  std::vector<double> breaks_;
  std::vector<ProbeBounds> cells_;  ///< by v, then u
};

/// Upper bound of the distance of surface points from the origin.
template <class Author>
double farthest_point(const double* q)
{
  constexpr double part = std::numbers::pi / 16.0;
  const auto sizes = constants<Author, OverCell>(q);
  const bool revolved = ChartDomain::of<Author>(q).revolved;
  const auto parts_u = revolved ? std::vector<AngleSpan>{{0.0, 0.0}} : equal_parts({}, part);
  double farthest = 0.0;
  for (const AngleSpan& u : parts_u)
    for (const AngleSpan& v : equal_parts({}, part)) {
      const Point<OverCell> x = Author::template chart<OverCell>(
          turn_range(u.center(), u.half(), false), turn_range(v.center(), v.half(), true), sizes.data());
      farthest = std::max(farthest, longest({x[0], x[1], x[2]}));
    }
  return farthest;
}

}  // namespace hauberk::kit
