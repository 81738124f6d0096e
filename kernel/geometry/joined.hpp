#pragma once
/// Which primitives of one element hang together.

#include <hauberk/shape.hpp>

#include <span>
#include <vector>

namespace hauberk {

/// Groups of primitives of one element that overlap or touch, directly or by others of their group: indices,
/// ascending within a group, groups in the order of their first. Of triangle meshes the balls that hold them
/// count, as only their facets know more. Thread safe.
std::vector<std::vector<int>> joined_primitives(std::span<const Primitive> primitives);

}  // namespace hauberk
