#pragma once
/// Places of an experiment by JSON pointers.

#include <hauberk/section.hpp>

#include <string_view>

namespace hauberk {

/// The node at `pointer`, or the closest one above it: where a problem is reported.
const Node& nearest_node(const Node& root, std::string_view pointer);

}  // namespace hauberk
