#pragma once
/// Closed triangle meshes of elements.

#include <hauberk/shape.hpp>

#include <array>
#include <span>
#include <vector>

namespace hauberk::exporting {

/// Corners are counter-clockwise seen from outside. Lengths in the unit of the experiment.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// Volume inside: a sixth of the sum of a . (b x c) over the triangles (divergence theorem).
double volume(const Mesh& mesh);

/// Appends `other`, turned and moved.
void append(Mesh& mesh, const Mesh& other, const Mat3& rotation, const Vec3& position);

/// Unit normals at the points: the mean of those of the triangles around, weighted by area.
std::vector<Vec3> point_normals(const Mesh& mesh);

/// The surface of a union of primitives in the element's frame: closed and oriented, every edge in two
/// triangles, one closed surface for each group of primitives that overlap. Points lie on the surface; facets
/// leave it by at most about `chord` (> 0), and the volume's error falls with it.
///
/// A primitive that overlaps no other is sampled by its chart, closer where it bends more. A group is the
/// zero set of the least of its fields, drawn by marching tetrahedra (six to a cube, as Kuhn divides it),
/// whose edges find the surface by bisection: ridges where primitives meet are cut by facets, in the order of
/// the chord, too. Throws InputError where a triangle mesh overlaps other primitives, and where the chord
/// would take more than 5,000,000 triangles of one element. Thread safe.
Mesh element_mesh(std::span<const Primitive> primitives, double chord);

/// Half of how thin the wires, tubes or walls of primitives are across, which chords are measured by.
double wire_radius(std::span<const Primitive> primitives);

/// The smallest radius of a tube or, of other solids, of curvature where they are convex, as far as it is
/// certified: what a grid has to be finer than.
double sharpest_radius(std::span<const Primitive> primitives);

/// Triangles of nu x nv quadrilaterals between points that follow `first` in rows of nv, closed both ways.
void close_both_ways(Mesh& mesh, int first, int nu, int nv);

/// Turns the triangles round where they enclose a negative volume.
void turn_outwards(Mesh& mesh);

/// Throws InputError that says so: an element would take so many.
[[noreturn]] void refuse_chord(double triangles, double chord);

}  // namespace hauberk::exporting
