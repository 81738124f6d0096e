#pragma once
/// Loops that several primitives of one element form together.
#include "model.hpp"

namespace hauberk::verification {

/// Where two primitives of one element overlap: coordinates on their cores, and a point of both.
struct Overlap {
  double u = 0.0, v = 0.0;
  Vec3 point = Vec3::Zero();
};

/// One for every part that the solids of a and b share, of a sampled solid a: neighbouring samples inside of
/// b are one part; a part between samples is found by descent of the signed distance to b. Where one of the
/// two is a plugin's solid, parts are stretches of a core along which the other surface is no farther than
/// the tube's radius; both must have cores. None for surfaces of triangles.
std::vector<Overlap> overlaps(const Primitive& a, const Primitive& b);

/// Closed polygons inside of an element, in its frame, that generate with the cores of its primitives all
/// that can be linked with it: for each overlap beyond those of a spanning tree the way through it and back.
std::vector<Loop> loops_together(const std::vector<Primitive>& tori);

/// Finds those of all elements of a scene; equal elements are looked at once.
void find_loops(Scene& scene);

}  // namespace hauberk::verification
