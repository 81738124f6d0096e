#pragma once
/// Segments along the section of a surface of revolution: bounds of the distance from it anywhere.

#include <hauberk/kit/surface_balls.hpp>

namespace hauberk::kit {

/// A binary tree over the section u = 0 of a surface that u turns about the axis z.
///
/// Turned about z into the half plane of the point x, a surface is the curve (rho, z)(v), and its distance
/// from x is the distance of (rho, z)(x) from this curve in the plane. Turning a point into a half plane
/// brings no two points farther apart, so that a part of the section that is within `radius` of its middle in
/// space is so in the plane. With the middle c and the half width k a part is also within `sag` of a straight
/// segment,
///
///     |x(0, v) - c - (v - v_c) x_v(c)| <= 1/2 |x_vv| k^2,
///
/// and where this segment lies in a half plane of the axis, the distance from it bounds the part's. Divided
/// where it is asked for as SurfaceBalls is; immutable, so that all calls are thread safe; q and the chart's
/// bounds must outlive it.
template <class Author>
class SectionSegments {
 public:
  SectionSegments(const double* q, const ChartBounds<Chart<Author, false>>& chart) : q_(q), chart_(chart)
  {
    segments_.resize((std::size_t{2} << (levels - 1)) - 1);
    for (int i = 0; i < 1 << (levels - 1); ++i) segments_[index(levels - 1, i)] = made(levels - 1, i);
    for (int level = levels - 2; level >= 0; --level)
      for (int i = 0; i < 1 << level; ++i) {
        Segment& whole = segments_[index(level, i)];
        whole = made(level, i);
        double radius = 0.0;
        for (int part = 2 * i; part <= 2 * i + 1; ++part) {
          const Segment& s = segments_[index(level + 1, part)];
          radius = std::max(radius, (s.center - whole.center).norm() + s.radius);
        }
        whole.radius = std::min(whole.radius, radius);
      }
  }

  /// Looks no further where a bound reaches `enough`.
  BallDistance of(const Vec3& x, double enough) const
  {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const double rho = std::hypot(x.x(), x.y());
    Search search{{rho, x.z()}, enough, unknown, unknown, Vec2::Zero()};
    const Segment& whole = segments_[0];
    descend(0, 0, whole, from(search.x, whole), search);
    const Eigen::Vector2d out =
        rho > 0.0 ? Eigen::Vector2d(x.x() / rho, x.y() / rho) : Eigen::Vector2d(1.0, 0.0);
    return {std::max(0.0, search.at_least * (1.0 - 1e-14)),
            {search.near.x() * out.x(), search.near.x() * out.y(), search.near.y()},
            search.distance};
  }

 private:
  using Vec2 = Eigen::Vector2d;

  struct Segment {
    Vec2 center;               ///< (rho, z) of the middle
    double radius;             ///< the part of the curve is within that of the middle
    Vec2 half = Vec2::Zero();  ///< from the middle to an end
    double sag = std::numeric_limits<double>::infinity();  ///< the part is within that of the segment
  };
  struct Search {
    Vec2 x;
    double enough, at_least, distance;
    Vec2 near;
  };

  static constexpr int levels = 8;    ///< that are kept; the finest has 128 segments
  static constexpr int deepest = 14;  ///< of those that are made where they are asked for
  static std::size_t index(int level, int i)
  {
    return (std::size_t{1} << level) - 1 + static_cast<std::size_t>(i);
  }

  Segment made(int level, int i) const
  {
    const double half = std::numbers::pi / (1 << level), v = (2 * i + 1) * half;
    const ProbeBounds b = chart_.over(0.0, v, 0.0, half);
    const auto x = Chart<Author, false>::template jet<2>(turn(0.0), turn(v), q_);
    Segment s{{std::hypot(x[0].c[0], x[1].c[0]), x[2].c[0]}, b.v * half * (1.0 + 1e-12)};
    // A section that goes beyond the axis comes back on the other side, as that of a chart with poles does.
    const double side = x[0].c[0] < 0.0 ? -1.0 : 1.0;
    const Vec2 along(side * half * x[0].c[2], half * x[2].c[2]);
    const bool in_half_plane =
        x[1].c[0] == 0.0 && x[1].c[2] == 0.0 && side * x[0].c[0] >= std::abs(along.x());
    if (in_half_plane) s.half = along, s.sag = 0.5 * b.vv * half * half * (1.0 + 1e-12);
    return s;
  }

  /// No point of the part is nearer to x.
  static double from(const Vec2& x, const Segment& s)
  {
    const Vec2 away = x - s.center;
    const double by_ball = away.norm() - s.radius;
    if (!(s.sag < s.radius)) return by_ball;
    const double square = s.half.squaredNorm();
    const double at = square > 0.0 ? std::clamp(away.dot(s.half) / square, -1.0, 1.0) : 0.0;
    return std::max(by_ball, (away - at * s.half).norm() - s.sag);
  }

  /// Takes `bound`, that of the part, where it reaches `enough` or nearly the distance of the nearest point
  /// that was seen, or halves the part, the nearer half first; what cannot lower the bound is passed over.
  void descend(int level, int i, const Segment& s, double bound, Search& search) const
  {
    constexpr double nearly = 0.98;
    const double center = (search.x - s.center).norm();
    if (center < search.distance) search.distance = center, search.near = s.center;
    if (bound >= search.at_least) return;
    if (bound >= std::min(search.enough, nearly * search.distance) || level == deepest) {
      search.at_least = bound;
      return;
    }
    const auto half = [&](int k) {
      return level + 1 < levels ? segments_[index(level + 1, k)] : made(level + 1, k);
    };
    const Segment one = half(2 * i), two = half(2 * i + 1);
    const double to_one = std::max(bound, from(search.x, one)), to_two = std::max(bound, from(search.x, two));
    if (to_one <= to_two) {
      descend(level + 1, 2 * i, one, to_one, search);
      descend(level + 1, 2 * i + 1, two, to_two, search);
    } else {
      descend(level + 1, 2 * i + 1, two, to_two, search);
      descend(level + 1, 2 * i, one, to_one, search);
    }
  }

  const double* q_;
  const ChartBounds<Chart<Author, false>>& chart_;
  std::vector<Segment> segments_;
};

}  // namespace hauberk::kit
