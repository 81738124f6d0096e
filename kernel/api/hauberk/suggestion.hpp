#pragma once
/// What somebody may have meant by a name that is not known.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (optimal string
/// alignment; ASCII letters compare without case at half a step, so a wrong case is the smallest mistake).
/// Counted in half steps. Thread safe.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate closest to `name` (the first of equals) where it may be a slip of the pen: at most a third
/// of the longer name, at least one letter, changed. Else empty. Thread safe.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean 'x'?" where a candidate is near, else "": for messages that list what is known themselves.
/// Thread safe.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// The end of a message about an unknown name: "; did you mean 'x'?", or "; known: 'a', 'b'" (each once)
/// where nothing is near, or "" without candidates. Thread safe.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hauberk
