#pragma once
/// Tables in Markdown, aligned so that they read as text, too.

#include <string>
#include <vector>

namespace hauberk::detail {

/// Text without what Markdown would take for markup or the end of a cell.
std::string markdown_text(const std::string& text);

/// All rows are as long as the header. The first column is aligned left, the others right.
class MarkdownTable {
 public:
  explicit MarkdownTable(std::vector<std::string> header);
  void row(std::vector<std::string> cells);
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace hauberk::detail
