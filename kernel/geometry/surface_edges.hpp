#pragma once
/// Edges of closed surfaces of triangles: which triangles share them, and loops of them.

#include <hauberk/triangle_surface.hpp>

namespace hauberk::detail {

/// An edge and its two triangles. `forward` runs from a to b, `backward` from b to a.
struct SurfaceEdge {
  int a = 0, b = 0;
  int forward = -1, backward = -1;
};

/// Edges in ascending order of (a, b), a < b. Throws InputError where an edge does not belong to two
/// triangles that run along it in opposite senses.
std::vector<SurfaceEdge> surface_edges(const std::vector<TriangleSurface::Triangle>& triangles,
                                       const std::vector<Vec3>& points);

/// Number of the connected part of every triangle, from 0 in order of first triangles.
std::vector<int> parts_of(const std::vector<SurfaceEdge>& edges, std::size_t triangle_count);

/// Loops that generate the first homology of a closed surface: of every edge outside of a tree of shortest
/// paths and of a tree of triangles across the others, the edge and the paths from its ends to where these
/// meet. The tree of triangles takes edges with long loops first, so that short ones are left (Erickson and
/// Whittlesey 2005). `part_points`: a point of each part.
std::vector<std::vector<int>> homology_loops(const std::vector<SurfaceEdge>& edges,
                                             const std::vector<Vec3>& points, std::size_t triangle_count,
                                             const std::vector<int>& part_points);

}  // namespace hauberk::detail
