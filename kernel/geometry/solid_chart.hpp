#pragma once
/// How the chart of a solid covers its surface.

#include <hauberk/solid.hpp>

#include <cmath>

namespace hauberk {

/// The coordinates of a chart, radians.
inline ProbeAngles chart_angles(double u, double v)
{
  return {std::cos(u), std::sin(u), std::cos(v), std::sin(v)};
}

enum class ChartCover {
  both_ways,      ///< once over [0, 2 pi]^2, closed along u and along v
  between_poles,  ///< once over 0 <= v <= pi; all points at v = 0 are one, and all at v = pi
  other           ///< with one of these poles alone, or twice and without them
};

/// From points of the chart at v = 0 and at v = pi, and from how the solid says that it folds. Thread safe.
ChartCover chart_cover(const Solid& solid);

}  // namespace hauberk
