#pragma once
/// Loops of surfaces of triangles, and how often closed polygons are linked.
#include "model.hpp"

#include <optional>
#include <string>

namespace hauberk::verification {

/// Loops of edges that generate the first homology of a closed surface: first a tree of triangles across
/// edges, then a tree of the edges that it does not cross; every edge left closes a loop. Throws Malformed,
/// which names `where`, where an edge is not that of two triangles in opposite senses.
std::vector<std::vector<int>> homology_loops(const Surface& surface, const std::string& where);

/// Linking number of two closed polygons that do not meet: the crossings of p over q in a view of both, by
/// their signs. As many must be over as under, and two views must agree; otherwise nothing.
std::optional<int> crossing_number(const std::vector<Vec3>& p, const std::vector<Vec3>& q);

}  // namespace hauberk::verification
