#pragma once
/// Which bodies of one element hang together.

#include "geometry/body.hpp"

#include <span>
#include <vector>

namespace hauberk {

/// Groups of bodies of one element that overlap or touch, directly or by others of their group: indices,
/// ascending within a group, groups in the order of their first. Of triangle meshes the balls that hold them
/// count, as only their facets know more. Thread safe.
std::vector<std::vector<int>> joined_bodies(std::span<const Body> bodies);

}  // namespace hauberk
