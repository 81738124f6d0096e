#pragma once
/// A design on the terminal.

#include "design/design_result.hpp"

#include <string>

namespace hauberk {

/// What became of it, target by target and variable by variable. `starts`: how many there were; `unit`: of
/// lengths.
std::string design_tables(const DesignResult& design, int starts, const std::string& unit);

}  // namespace hauberk
