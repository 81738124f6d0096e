#include "geometry/thinnest_wall.hpp"

#include "geometry/solid_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace hauberk {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Ways straight in from a surface until they come out.
class InwardWays {
 public:
  explicit InwardWays(const Solid& solid)
      : solid_(solid),
        most_(2.0 * solid.radius()),
        step_(std::clamp(0.5 * solid.thickness(), 1e-3 * most_, 0.025 * most_))
  {
  }

  struct Way {
    double length = 0.0;
    Vec3 to, normal;    ///< where it comes out, and the normal there
    double lean = 1.0;  ///< of that normal from the way: 0 where they are parallel
  };

  Way from(const Vec3& x, const Vec3& normal) const
  {
    const auto depth = [&](double length) { return solid_.distance(x - length * normal).distance; };
    double inside = 0.0, outside = 0.0, d_in = 0.0, d_out = 0.0;
    do {
      inside = outside, d_in = d_out;
      outside += step_;
      d_out = depth(outside);
    } while (d_out < 0.0 && outside < most_);
    // The signed distance is nearly linear there: secants, and halves where they do not get on.
    constexpr int steps = 60;
    for (int k = 0; k < steps && outside - inside > 1e-9 * most_; ++k) {
      const double part =
          k % 2 == 0 && d_out > d_in ? std::clamp(d_in / (d_in - d_out), 1e-4, 1.0 - 1e-4) : 0.5;
      const double middle = inside + part * (outside - inside), d = depth(middle);
      (d < 0.0 ? inside : outside) = middle;
      (d < 0.0 ? d_in : d_out) = d;
    }
    Way way{outside, x - outside * normal, solid_.distance(x - outside * normal).normal};
    way.lean = (way.normal + normal).norm();
    return way;
  }

 private:
  const Solid& solid_;
  double most_, step_;
};

}  // namespace

double thinnest_wall(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles,
                     std::size_t rays, bool inside_out)
{
  const std::size_t stride = std::max<std::size_t>(1, triangles.size() / std::max<std::size_t>(1, rays));
  Vec3 low = Vec3::Constant(infinite), high = -low;
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double across = (high - low).norm();
  double least = infinite;
  for (std::size_t k = 0; k < triangles.size(); k += stride) {
    const auto& t = triangles[k];
    const std::array<Vec3, 3> c{points[t[0]], points[t[1]], points[t[2]]};
    const Vec3 middle = (c[0] + c[1] + c[2]) / 3.0;
    const Vec3 inward = (inside_out ? 1.0 : -1.0) * (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    for (std::size_t j = 0; j < triangles.size(); ++j) {
      if (j == k) continue;
      const auto& o = triangles[j];
      const Vec3 &p = points[o[0]], &q = points[o[1]], &r = points[o[2]];
      // Moeller and Trumbore 1997.
      const Vec3 e1 = q - p, e2 = r - p, h = inward.cross(e2), s = middle - p;
      const double det = e1.dot(h);
      if (std::abs(det) < 1e-14 * e1.norm() * e2.norm()) continue;
      const double u = s.dot(h) / det;
      if (u < 0.0 || u > 1.0) continue;
      const Vec3 w = s.cross(e1);
      const double v = inward.dot(w) / det, way = e2.dot(w) / det;
      if (v >= 0.0 && u + v <= 1.0 && way > 1e-9 * across) least = std::min(least, way);
    }
  }
  return std::isfinite(least) ? least : 0.0;
}

double thinnest_wall(const Solid& solid)
{
  if (solid.probe_dimension() == 1) return 2.0 * solid.offset();
  constexpr int around = 16, times = 40;
  constexpr double turn = 2.0 * std::numbers::pi / around;
  constexpr double square = 1e-3;  // a way that leans by that is longer by some 1e-6
  constexpr double beside = 1.05;  // of the least: no other place is looked for from farther
  const InwardWays ways(solid);
  std::vector<InwardWays::Way> first;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < around; ++j) {
      const Vec3 x = solid.surface_point(chart_angles(i * turn, j * turn));
      first.push_back(ways.from(x, solid.distance(x).normal));
    }
  std::ranges::sort(first, {}, [](const InwardWays::Way& way) { return std::pair(way.lean, way.length); });
  double least = infinite, shortest = infinite;
  for (InwardWays::Way& way : first) {
    shortest = std::min(shortest, way.length);
    if (way.length > beside * least) continue;
    for (int k = 0; k < times && way.lean > square; ++k) way = ways.from(way.to, way.normal);
    if (way.lean <= square) least = std::min(least, way.length);
  }
  return std::isfinite(least) ? least : shortest;
}

}  // namespace hauberk
