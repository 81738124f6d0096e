#pragma once
/// Tables for a terminal.

#include <cstddef>
#include <string>
#include <vector>

namespace hauberk {

/// Lines of cells below each other, flush right, those of the first `left` columns flush left.
std::string text_table(const std::vector<std::vector<std::string>>& cells, std::size_t left = 0);

}  // namespace hauberk
