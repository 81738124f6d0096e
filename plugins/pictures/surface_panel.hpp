#pragma once
/// A surface of triangles around the origin, seen from one side.

#include "pictures/boundary_points.hpp"
#include "pictures/svg.hpp"

#include <array>
#include <string>

namespace hauberk::detail {

/// Where it is seen from: orthonormal, right x up = toward the viewer.
struct View {
  std::string title;
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), toward = Vec3::UnitZ();
};

/// Along an axis: the plane of the axes `across` and `upward` (0, 1, 2).
View plane_view(int across, int upward, const std::array<std::string, 3>& names);
/// From above the first axis, between it and the second.
View oblique_view();

/// Draws the panel into the square of `size` whose left upper corner is `corner`. `reach` is the largest
/// coordinate that is shown, the same for panels to be compared.
void draw_surface(Svg& svg, Point2 corner, double size, const View& view, const BoundaryPoints& surface,
                  double reach, const std::array<std::string, 3>& names);

}  // namespace hauberk::detail
