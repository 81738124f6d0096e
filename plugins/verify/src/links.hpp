#pragma once
/// Linking numbers by crossings of polygons.

#include "model.hpp"

#include <string>

namespace hauberk::verification {

/// Linking number of two disjoint core circles, each oriented about its z axis: the crossings of b through
/// a's disc, each counted by its direction. -1, 0 or 1.
/// Of curves Gauss's integral; with surfaces of triangles or solids the greatest common divisor of the
/// linking numbers of loops that generate the homology of both, of a solid those that its plugin gives.
int linking_number(const Primitive& a, const Primitive& b);

/// A pair of cycles that are linked.
struct Link {
  std::array<int, 2> elements{};
  std::array<int, 2> primitives{};  ///< from the number of an element's primitives on, its loops
  Image image{};
  int number = 0;
  bool operator==(const Link&) const = default;
};

/// All links between different elements and images, in a fixed order: of cores, and of the loops that several
/// primitives form together. Throws Malformed where a loop meets another element, so that no number is.
std::vector<Link> links(const Scene& scene, const std::vector<Place>& places, const Mat3& F);

/// What differs between the links at rest and those at the limit; empty when nothing does.
std::string difference(const std::vector<Link>& rest, const std::vector<Link>& limit);

}  // namespace hauberk::verification
