#pragma once
/// Cells and lines of comma-separated tables (RFC 4180).

#include <hauberk/direction.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk::detail {

/// Quotes around text that holds a separator, quote or line end; inner quotes doubled. Text that a
/// spreadsheet would take for a formula begins with an apostrophe, and control characters are shown
/// (plain_text).
std::string text_cell(const std::string& text);
/// Reads back exactly; empty where there is no (finite) number.
std::string number_cell(const std::optional<double>& x);
/// An angle in degrees; the components in brackets, separated by spaces.
std::string direction_cell(const Direction& direction);
/// Cells joined, with a line end.
std::string csv_line(const std::vector<std::string>& cells);

}  // namespace hauberk::detail
