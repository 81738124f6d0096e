#pragma once
/// How thin closed surfaces are across, as one who prints them asks.

#include <hauberk/linalg.hpp>
#include <hauberk/solid.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace hauberk {

/// Way of a ray from the middle of a triangle straight into a closed surface of triangles, until it comes
/// out: the least of about so many rays, one from every so many-th triangle. Corners are counter-clockwise
/// seen from outside, from inside if `inside_out`. 0 where no ray comes out: the surface is not closed.
/// Thread safe.
double thinnest_wall(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles,
                     std::size_t rays, bool inside_out = false);

/// The shortest way through a solid that is square to its surface at both ends, of those that are found from
/// points all over its chart: from where the way straight in comes out the next goes straight in. About a
/// way that is shorter than its neighbours this converges: of a section with the half-axes a >= b what lies
/// beside the shorter one by s lies beside it by |1 - 2 (b/a)^2| s then. The ends of the longer one, towards
/// which a wire grows thinner and thinner, do not count. Of a probe that is a curve twice its offset. Thread
/// safe.
double thinnest_wall(const Solid& solid);

}  // namespace hauberk
