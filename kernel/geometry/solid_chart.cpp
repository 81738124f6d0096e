#include "geometry/solid_chart.hpp"

#include <numbers>

namespace hauberk {
namespace {

/// Whether all points of the chart at this v are one.
bool is_pole(const Solid& solid, double v)
{
  constexpr int lines = 24;
  constexpr double rounding = 1e-12;
  const double most = rounding * solid.radius();
  const Vec3 first = solid.surface_point(chart_angles(0.0, v));
  for (int k = 1; k < lines; ++k) {
    const Vec3 other = solid.surface_point(chart_angles(2.0 * std::numbers::pi * k / lines, v));
    if (!((other - first).norm() <= most)) return false;
  }
  return true;
}

}  // namespace

ChartCover chart_cover(const Solid& solid)
{
  const bool first = is_pole(solid, 0.0), second = is_pole(solid, std::numbers::pi);
  if (first && second) return ChartCover::between_poles;
  const bool twice =
      solid.fold() == Fold::pole || (solid.fold() == Fold::mirror && solid.probe_dimension() == 2);
  return first || second || twice ? ChartCover::other : ChartCover::both_ways;
}

}  // namespace hauberk
