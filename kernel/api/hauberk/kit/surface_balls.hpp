#pragma once
/// Balls that cover a surface, as a tree: bounds of the distance from it anywhere, whatever its field.

#include <hauberk/kit/chart_bounds.hpp>

namespace hauberk::kit {

/// What a tree of balls tells of a point.
struct BallDistance {
  double at_least = 0.0;  ///< no point of the surface is nearer
  Vec3 near;              ///< a point of the surface, the nearest of those that were looked at
  double distance = 0.0;  ///< from it
};

/// A quad-tree over the chart. A ball stands at the surface point in the middle of its cell and is as large
/// as the chart's first derivatives say, or as its four quarters need. Immutable, so that all calls are
/// thread safe.
template <class Author>
class SurfaceBalls {
 public:
  SurfaceBalls(const double* q, const ChartBounds<Chart<Author, false>>& chart)
  {
    balls_.resize(first(levels));
    for (int level = levels - 1; level >= 0; --level)
      for (int i = 0; i < side(level); ++i)
        for (int j = 0; j < side(level); ++j) make(q, chart, level, i, j);
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
  struct Cell {
    int level, i, j;
  };

  static constexpr int levels = 7;  ///< the finest has 64 x 64 balls
  static constexpr int side(int level) { return 1 << level; }
  /// Where a level begins: after 1 + 4 + ... balls.
  static constexpr int first(int level) { return ((1 << (2 * level)) - 1) / 3; }
  static int index(int level, int i, int j) { return first(level) + i * side(level) + j; }

  void make(const double* q, const ChartBounds<Chart<Author, false>>& chart, int level, int i, int j)
  {
    const double half = std::numbers::pi / side(level), u = (2 * i + 1) * half, v = (2 * j + 1) * half;
    Ball& ball = balls_[index(level, i, j)];
    ball = {chart_point<Author>(turn(u), turn(v), q), 0.0};
    if (level + 1 == levels) {
      const ProbeBounds b = chart.over(u, v, half, half);
      ball.radius = (b.u + b.v) * half * (1.0 + 1e-12);
      return;
    }
    for (const Cell& c : quarters({level, i, j})) {
      const Ball& part = balls_[index(c.level, c.i, c.j)];
      ball.radius = std::max(ball.radius, (part.center - ball.center).norm() + part.radius);
    }
  }

  static std::array<Cell, 4> quarters(const Cell& c)
  {
    const int level = c.level + 1, i = 2 * c.i, j = 2 * c.j;
    return {{{level, i, j}, {level, i + 1, j}, {level, i, j + 1}, {level, i + 1, j + 1}}};
  }

  /// Into the nearer quarters first; what cannot lower the bound is passed over.
  void descend(const Vec3& x, double enough, const Cell& cell, BallDistance& found) const
  {
    const Ball& ball = balls_[index(cell.level, cell.i, cell.j)];
    const double center = (x - ball.center).norm();
    if (center < found.distance) found.distance = center, found.near = ball.center;
    if (center - ball.radius >= found.at_least) return;
    if (center - ball.radius >= enough || cell.level + 1 == levels) {
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

  std::vector<Ball> balls_;
};

}  // namespace hauberk::kit
