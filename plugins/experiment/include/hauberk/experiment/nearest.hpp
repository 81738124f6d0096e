#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (optimal string
/// alignment; ASCII letters compare without case at half a step, so a wrong case is the smallest mistake).
/// Counted in half steps.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit distance to `name` (the first of equals), empty without candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "; the nearest known <what> is 'x'", or "" without candidates.
std::string nearest_hint(std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates);

}  // namespace hauberk
