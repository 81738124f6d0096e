#pragma once
/// A design on the terminal.

#include "design/design_result.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// What became of it, target by target and variable by variable. `starts`: how many there were; `units`: of
/// the variables, empty for numbers.
std::string design_tables(const DesignResult& design, int starts, const std::vector<std::string>& units);

}  // namespace hauberk
