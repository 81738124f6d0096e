#include "tasks/transition/jumps.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace hauberk {
namespace {

struct Interval {
  PathPoint a, m, b;
  double residual = 0.0;

  double width() const { return b.s - a.s; }
};

/// |f(y) - f(x)|
double change(const PathPoint& x, const PathPoint& y, Quantity quantity)
{
  return quantity == Quantity::energy ? std::abs(y.energy - x.energy) : (y.gradient - x.gradient).norm();
}

double simpson_residual(const Interval& i, Quantity quantity)
{
  const double sixth = i.width() / 6.0;
  if (quantity == Quantity::energy)
    return std::abs(i.b.energy - i.a.energy - sixth * (i.a.slope + 4.0 * i.m.slope + i.b.slope));
  const Vec6 integral = sixth * (i.a.gradient_slope + 4.0 * i.m.gradient_slope + i.b.gradient_slope);
  return (i.b.gradient - i.a.gradient - integral).norm();
}

/// Simpson's residual, but where a derivative diverges it says nothing about the function: a discontinuity
/// lies in one of the halves, and changes the function there.
double residual(const Interval& i, Quantity quantity)
{
  const double r = simpson_residual(i, quantity);
  const double most = 2.0 * std::max(change(i.a, i.m, quantity), change(i.m, i.b, quantity));
  return r < most ? r : most;  // also where r is not a number
}

/// Of an interval so narrow that only a discontinuity matters: the least that any of its slopes leaves, which
/// agree unless a slope diverges there.
double size_of(const Interval& i, Quantity quantity)
{
  double least = std::numeric_limits<double>::infinity();
  for (const PathPoint* p : {&i.a, &i.m, &i.b}) {
    const Vec6 turned = i.b.gradient - i.a.gradient - i.width() * p->gradient_slope;
    const double left = quantity == Quantity::energy
                            ? std::abs(i.b.energy - i.a.energy - i.width() * p->slope)
                            : turned.norm();
    if (std::isfinite(left)) least = std::min(least, left);
  }
  return std::isfinite(least) ? least : change(i.a, i.b, quantity);
}

}  // namespace

Jump largest_jump(const PathFunction& f, Quantity quantity, int intervals, int most_splits, double enough,
                  double narrowest)
{
  const auto smaller = [](const Interval& x, const Interval& y) {
    return x.residual < y.residual || (x.residual == y.residual && x.a.s > y.a.s);
  };
  std::priority_queue<Interval, std::vector<Interval>, decltype(smaller)> queue(smaller);
  Jump jump;
  const auto insert = [&](const PathPoint& a, const PathPoint& b) {
    Interval i{a, f(0.5 * (a.s + b.s)), b, 0.0};
    i.residual = residual(i, quantity);
    queue.push(std::move(i));
  };
  PathPoint last = f(0.0);
  for (int k = 1; k <= intervals; ++k) {
    const PathPoint next = f(static_cast<double>(k) / intervals);
    insert(last, next);
    last = next;
  }
  for (int splits = 0; splits < most_splits && !queue.empty();) {
    if (queue.top().residual <= enough) break;
    const Interval i = queue.top();
    queue.pop();
    if (i.width() <= narrowest) {
      if (const double size = size_of(i, quantity); size > jump.size) {
        jump.size = size;
        jump.at = i.m.s;
      }
      continue;
    }
    insert(i.a, i.m);
    insert(i.m, i.b);
    ++splits;
  }
  if (!queue.empty()) jump.resolution = queue.top().residual;
  return jump;
}

}  // namespace hauberk
