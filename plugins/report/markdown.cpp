#include "report/markdown.hpp"

#include "document/plain_text.hpp"

#include <algorithm>

namespace hauberk::detail {
namespace {

/// Characters, not bytes, of UTF-8.
std::size_t width(const std::string& text)
{
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
}

}  // namespace

std::string markdown_text(const std::string& text)
{
  std::string out;
  for (const char c : plain_text(text, LineBreaks::kept)) {
    if (c == '\n') {
      out += ' ';
      continue;
    }
    // Underscores within words, as names have them, are none of its markup.
    if (std::string("\\`*[]<>|#").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

MarkdownTable::MarkdownTable(std::vector<std::string> header) { row(std::move(header)); }

void MarkdownTable::row(std::vector<std::string> cells)
{
  for (std::string& cell : cells) cell = markdown_text(cell);
  rows_.push_back(std::move(cells));
}

std::string MarkdownTable::text() const
{
  std::vector<std::size_t> widths(rows_.front().size(), 3);
  for (const auto& row : rows_) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  std::string out;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t k = 0; k < widths.size(); ++k) {
      const std::string& cell = rows_[r][k];
      const std::string room(widths[k] - width(cell), ' ');
      out += k == 0 ? "| " : " | ";
      out += k == 0 ? cell : room;
      out += k == 0 ? room : cell;
    }
    out += " |\n";
    if (r > 0) continue;
    for (std::size_t k = 0; k < widths.size(); ++k)
      out += k == 0 ? "| " + std::string(widths[k], '-') : " | " + std::string(widths[k] - 1, '-') + ":";
    out += " |\n";
  }
  return out;
}

}  // namespace hauberk::detail
