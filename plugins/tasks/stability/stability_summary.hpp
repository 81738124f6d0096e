#pragma once
/// A stability map as lines for a terminal.

#include "tasks/stability/stability_results.hpp"

#include <string>

namespace hauberk {

/// Table of outcomes, families times methods, and a line for each case that is not verified.
std::string stability_summary(const StabilityMap& map);

}  // namespace hauberk
