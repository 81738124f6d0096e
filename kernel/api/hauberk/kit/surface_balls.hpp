#pragma once
/// Balls that cover a surface, as a tree: bounds of the distance from it anywhere, whatever its field.

#include <hauberk/kit/chart_bounds.hpp>

namespace hauberk::kit {

/// What a tree of balls, or of segments, tells of a point.
struct BallDistance {
  double at_least = 0.0;  ///< no point of the surface is nearer
  Vec3 near;              ///< a point of the surface, the nearest of those that were looked at
  double distance = 0.0;  ///< from it
};

/// A quad-tree over the chart. A ball stands at the surface point in the middle of its cell and is as large
/// as the chart's first derivatives say, or as its four quarters need. The finest cells are known better:
/// with the middle c and half widths h and k,
///
///     |x(u, v) - c - (u - u_c) x_u(c) - (v - v_c) x_v(c)| <= 1/2 (|x_uu| h^2 + 2 |x_uv| h k + |x_vv| k^2),
///
/// so that such a cell is within that of a parallelogram, and the distance is known to second order. What
/// they leave open is divided further where it is asked for. Immutable, so that all calls are thread safe; q
/// and the chart's bounds must outlive it.
template <class Author>
class SurfaceBalls {
 public:
  SurfaceBalls(const double* q, const ChartBounds<Chart<Author, false>>& chart) : q_(q), chart_(chart)
  {
    balls_.resize(first(levels));
    plates_.reserve(static_cast<std::size_t>(side(levels - 1)) * side(levels - 1));
    for (int i = 0; i < side(levels - 1); ++i)
      for (int j = 0; j < side(levels - 1); ++j) {
        plates_.push_back(plate({levels - 1, i, j}));
        balls_[index(levels - 1, i, j)] = plates_.back().ball;
      }
    for (int level = levels - 2; level >= 0; --level)
      for (int i = 0; i < side(level); ++i)
        for (int j = 0; j < side(level); ++j) hold_quarters({level, i, j});
  }

  /// Looks no further where a bound reaches `enough`.
  BallDistance of(const Vec3& x, double enough) const
  {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    BallDistance found{unknown, Vec3::Zero(), unknown};
    descend(x, enough, {0, 0, 0}, found);
    found.at_least = std::max(0.0, found.at_least * (1.0 - 1e-14));
    return found;
  }

 private:
  struct Ball {
    Vec3 center;
    double radius;
  };
  /// A cell by itself: c + a x_u h + b x_v k for a and b from -1 to 1, and how far from there it goes.
  struct Plate {
    Ball ball;
    Vec3 u, v;
    double sag;
  };
  struct Cell {
    int level, i, j;
  };

  static constexpr int levels = 7;    ///< that are kept; the finest has 64 x 64 balls
  static constexpr int deepest = 12;  ///< of those that are made where they are asked for
  static constexpr int side(int level) { return 1 << level; }
  /// Where a level begins: after 1 + 4 + ... balls.
  static constexpr int first(int level) { return ((1 << (2 * level)) - 1) / 3; }
  static int index(int level, int i, int j) { return first(level) + i * side(level) + j; }

  Plate plate(const Cell& cell) const
  {
    const double half = std::numbers::pi / side(cell.level);
    const double u = (2 * cell.i + 1) * half, v = (2 * cell.j + 1) * half;
    const ProbeBounds b = chart_.over(u, v, half, half);
    const auto x = Chart<Author, false>::template jet<2>(turn(u), turn(v), q_);
    const auto part = [&](std::size_t m, double by) {
      return Vec3(by * x[0].c[m], by * x[1].c[m], by * x[2].c[m]);
    };
    return {{part(0, 1.0), (b.u + b.v) * half * (1.0 + 1e-12)},
            part(1, half),
            part(2, half),
            0.5 * (b.uu + 2.0 * b.uv + b.vv) * half * half * (1.0 + 1e-12)};
  }

  void hold_quarters(const Cell& cell)
  {
    const double half = std::numbers::pi / side(cell.level);
    Ball& ball = balls_[index(cell.level, cell.i, cell.j)];
    ball = {chart_point<Author>(turn((2 * cell.i + 1) * half), turn((2 * cell.j + 1) * half), q_), 0.0};
    for (const Cell& c : quarters(cell)) {
      const Ball& part = balls_[index(c.level, c.i, c.j)];
      ball.radius = std::max(ball.radius, (part.center - ball.center).norm() + part.radius);
    }
  }

  static std::array<Cell, 4> quarters(const Cell& c)
  {
    const int level = c.level + 1, i = 2 * c.i, j = 2 * c.j;
    return {{{level, i, j}, {level, i + 1, j}, {level, i, j + 1}, {level, i + 1, j + 1}}};
  }

  /// The least of |w - a u - b v|^2 over a and b from -1 to 1: inside, or on one of the four edges.
  static double least_square(const Vec3& w, const Vec3& u, const Vec3& v)
  {
    const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), wu = w.dot(u), wv = w.dot(v);
    const auto at = [&](double a, double b) { return (w - a * u - b * v).squaredNorm(); };
    const double det = uu * vv - uv * uv;
    if (det > 0.0) {
      const double a = (vv * wu - uv * wv) / det, b = (uu * wv - uv * wu) / det;
      if (std::abs(a) <= 1.0 && std::abs(b) <= 1.0) return at(a, b);
    }
    const auto nearest = [](double slope, double bend) {
      return bend > 0.0 ? std::clamp(slope / bend, -1.0, 1.0) : 0.0;
    };
    double least = std::numeric_limits<double>::infinity();
    for (const double end : {-1.0, 1.0}) {
      least = std::min(least, at(end, nearest(wv - end * uv, vv)));
      least = std::min(least, at(nearest(wu - end * uv, uu), end));
    }
    return least;
  }

  /// From a plate: by its ball, or by its parallelogram.
  static double from(const Vec3& x, const Plate& plate)
  {
    const Vec3 away = x - plate.ball.center;
    const double by_ball = away.norm() - plate.ball.radius;
    if (!(plate.sag < plate.ball.radius)) return by_ball;
    return std::max(by_ball, std::sqrt(least_square(away, plate.u, plate.v)) - plate.sag);
  }

  /// Takes `bound`, that of a plate, where it reaches `enough` or nearly the distance of the nearest point
  /// that was seen, or divides the plate, the nearer quarters first; what cannot lower `found` is passed
  /// over.
  void divide(const Vec3& x, double enough, const Cell& cell, double bound, BallDistance& found) const
  {
    constexpr double nearly = 0.98;
    if (bound >= found.at_least) return;
    if (bound >= std::min(enough, nearly * found.distance) || cell.level == deepest) {
      found.at_least = bound;
      return;
    }
    std::array<std::pair<double, int>, 4> order;
    const auto parts = quarters(cell);
    for (int k = 0; k < 4; ++k) {
      const Plate part = plate(parts[k]);
      const double center = (x - part.ball.center).norm();
      if (center < found.distance) found.distance = center, found.near = part.ball.center;
      order[k] = {std::max(bound, from(x, part)), k};
    }
    std::sort(order.begin(), order.end());
    for (const auto& [lower, k] : order) divide(x, enough, parts[k], lower, found);
  }

  /// Into the nearer quarters first; what cannot lower the bound is passed over.
  void descend(const Vec3& x, double enough, const Cell& cell, BallDistance& found) const
  {
    const Ball& ball = balls_[index(cell.level, cell.i, cell.j)];
    const double center = (x - ball.center).norm();
    if (center < found.distance) found.distance = center, found.near = ball.center;
    if (center - ball.radius >= found.at_least) return;
    if (cell.level + 1 == levels) {
      const auto at = static_cast<std::size_t>(cell.i * side(levels - 1) + cell.j);
      return divide(x, enough, cell, from(x, plates_[at]), found);
    }
    if (center - ball.radius >= enough) {
      found.at_least = center - ball.radius;
      return;
    }
    std::array<std::pair<double, int>, 4> order;
    const auto parts = quarters(cell);
    for (int k = 0; k < 4; ++k) {
      const Ball& part = balls_[index(parts[k].level, parts[k].i, parts[k].j)];
      order[k] = {(x - part.center).norm() - part.radius, k};
    }
    std::sort(order.begin(), order.end());
    for (const auto& [bound, k] : order)
      if (bound < found.at_least) descend(x, enough, parts[k], found);
  }

  const double* q_;
  const ChartBounds<Chart<Author, false>>& chart_;
  std::vector<Ball> balls_;
  std::vector<Plate> plates_;  ///< of the finest level
};

}  // namespace hauberk::kit
