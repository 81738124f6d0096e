#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// The candidate closest to `name` by edit distance, if that is close enough to be a slip of the pen (at most
/// a third of the longer name, at least one letter); else an empty string. Ties: the first.
std::string nearest_id(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hauberk
