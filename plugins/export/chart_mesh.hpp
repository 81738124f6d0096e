#pragma once
/// The surface of a solid by its chart.

#include "export/mesh.hpp"

#include <hauberk/solid.hpp>

#include <optional>

namespace hauberk::exporting {

/// Facets between points of the chart at values of u and of v that lie as close as the surface bends there: a
/// chord between neighbours along either leaves the surface by at most about half of `chord`. In the frame of
/// the solid, and outward. Null where the chart covers the surface neither both ways nor between poles
/// (ChartCover). Throws InputError where that takes more than `most_triangles`. Thread safe.
std::optional<Mesh> chart_mesh(const Solid& solid, double chord, double most_triangles);

}  // namespace hauberk::exporting
