#pragma once
/// Meshes, as contact `mesh` has them: of tori by their rule, of surfaces as they are; by brute force, not by
/// the program's code.
#include "model.hpp"

namespace hauberk::verification {

/// Smallest distance of two meshes; negative when an edge of one goes through a triangle of the other: then
/// minus how far the edge's nearer end is behind that triangle's plane. Both tori must have facets.
double mesh_separation(const Primitive& a, const Primitive& b);

/// Distance of x to the mesh.
double mesh_distance(const Primitive& torus, const Vec3& x);

/// By how much a mesh may stick out of its torus: chords cut across the hole.
double mesh_excess(const Primitive& torus);

}  // namespace hauberk::verification
