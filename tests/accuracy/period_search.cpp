#include "period_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace hauberk::brute {
namespace {

constexpr Sampling coarse{512, 96, 32};
constexpr std::size_t unknowns = 5;
using Point = std::array<double, unknowns>;

/// Minimum of f by Nelder and Mead's simplex; `size` is its first edge.
std::pair<Point, double> simplex_search(const std::function<double(const Point&)>& f, const Point& start,
                                        double size, int most_calls)
{
  std::vector<std::pair<double, Point>> s;
  int calls = 0;
  const auto value = [&](const Point& x) {
    ++calls;
    return f(x);
  };
  s.emplace_back(value(start), start);
  for (std::size_t k = 0; k < unknowns; ++k) {
    Point x = start;
    x[k] += size;
    s.emplace_back(value(x), x);
  }
  const auto by_value = [](const auto& a, const auto& b) { return a.first < b.first; };
  while (calls < most_calls) {
    std::sort(s.begin(), s.end(), by_value);
    if (s.back().first - s.front().first < 1e-9) break;
    Point mid{};
    for (std::size_t k = 0; k < unknowns; ++k) {
      for (const std::size_t i : {0, 1, 2, 3, 4}) mid[k] += s[i].second[k] / unknowns;
    }
    const auto along = [&](double t) {
      Point x;
      for (std::size_t k = 0; k < unknowns; ++k) x[k] = mid[k] + t * (s.back().second[k] - mid[k]);
      return std::pair{value(x), x};
    };
    const auto reflected = along(-1.0);
    if (reflected.first < s.front().first) {
      s.back() = std::min(reflected, along(-2.0), by_value);
    } else if (reflected.first < s[unknowns - 1].first) {
      s.back() = reflected;
    } else {
      const auto inner = along(reflected.first < s.back().first ? -0.5 : 0.5);
      if (inner.first < std::min(reflected.first, s.back().first)) {
        s.back() = inner;
      } else {
        for (std::size_t i = 1; i < s.size(); ++i) {
          for (std::size_t k = 0; k < unknowns; ++k) s[i].second[k] = 0.5 * (s[i].second[k] + s[0].second[k]);
          s[i].first = value(s[i].second);
        }
      }
    }
  }
  std::sort(s.begin(), s.end(), by_value);
  return {s.front().second, s.front().first};
}

}  // namespace

double largest_offset(Torus A, Torus B, double y)
{
  A.center = Vec3::Zero();
  const auto gap = [&](double x) {
    B.center = Vec3(x, y, 0.0);
    return surface_distance(A, B, coarse);
  };
  const double top = A.R + B.R - A.r0 - B.r0 + 1e-3 * A.R;
  constexpr int scans = 24;
  double outside = top;
  for (int k = 1; k <= scans; ++k) {
    const double x = top * (1.0 - 0.5 * k / scans);
    if (gap(x) > 0.0 && gauss_linking(A, B) != 0) {
      double lo = x, hi = outside;
      for (int it = 0; it < 34; ++it) {
        const double mid = 0.5 * (lo + hi);
        const bool free = gap(mid) > 0.0 && gauss_linking(A, B) != 0;
        (free ? lo : hi) = mid;
      }
      return lo;
    }
    outside = x;
  }
  return 0.0;
}

double longest_period(const Torus& A, const Torus& B, int starts)
{
  const auto axes = [](double p, double q, const Vec3& axis) -> Mat3 {
    return rotation_exp(Vec3(p, q, 0.0)) * rotation_from_z(axis);
  };
  const auto minus_period = [&](const Point& x) {
    Torus a = A, b = B;
    a.axes = axes(x[0], x[1], Vec3(0, 0, 1));
    b.axes = rotation_exp(Vec3(x[2], 0.0, x[3])) * rotation_from_z(Vec3(0, 1, 0));
    const double ab = largest_offset(a, b, x[4]);
    // From B to the next A: seen from B as origin.
    const double ba = largest_offset(b, a, -x[4]);
    return -(ab + ba);
  };
  double best = 0.0;
  std::mt19937_64 rng(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < starts; ++k) {
    Point x{};
    for (double& c : x) c = k == 0 ? 0.02 * u(rng) : 0.4 * u(rng);
    double value = 0.0;
    for (const double size : {0.2, 0.05, 0.01, 0.002}) {
      const auto [at, found] = simplex_search(minus_period, x, size, 160);
      x = at;
      value = found;
    }
    best = std::max(best, -value);
  }
  return best;
}

}  // namespace hauberk::brute
