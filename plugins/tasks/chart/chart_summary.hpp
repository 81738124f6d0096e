#pragma once
/// A chart as lines for a terminal.

#include "tasks/chart/chart_results.hpp"

#include <string>

namespace hauberk {

/// Table of points, and a line for each that has no error.
std::string chart_summary(const PrecisionChart& chart);

}  // namespace hauberk
