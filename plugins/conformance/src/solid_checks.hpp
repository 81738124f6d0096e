#pragma once
/// What a solid says of itself, against samples and differences.

#include "random.hpp"

#include <hauberk/shape.hpp>
#include <hauberk/solid.hpp>

#include <vector>

namespace hauberk::conformance {

/// n x n points of the surface, evenly in its coordinates.
std::vector<Vec3> solid_points(const Solid& solid, int n);

/// The surface is where the distance is zero, probes are where they have to be, derivatives are those of
/// differences and bounds are above what is sampled. Throws Failure.
void check_solid(const Primitive& primitive, Random& random);

/// What a solid says of the way to the sizes of another one of its kind: it makes the same solid of them, and
/// its surface moves no farther than its speed. Nothing is compared where it knows no way.
void check_motion(const Primitive& from, const Primitive& to, Random& random);

/// Distances of the one with all lengths times `factor` are as many times as large.
void require_scaled(const Primitive& small, const Primitive& large, double factor, Random& random);

}  // namespace hauberk::conformance
