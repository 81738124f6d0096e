#include "run/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {

std::string text_table(const std::vector<std::vector<std::string>>& cells, std::size_t left)
{
  std::vector<std::size_t> widths;
  for (const auto& line : cells) {
    widths.resize(std::max(widths.size(), line.size()), 0);
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  }
  std::string text;
  for (const auto& line : cells) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (k > 0) text += "  ";
      text +=
          k < left ? fmt::format("{:<{}}", line[k], widths[k]) : fmt::format("{:>{}}", line[k], widths[k]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace hauberk
