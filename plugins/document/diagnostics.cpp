#include "document/diagnostics.hpp"

#include "document/jsonc.hpp"

#include <algorithm>

namespace hauberk {

namespace {

/// Keys and strings of a file may hold line breaks and terminal codes; a problem is one line of plain text.
std::string printable(const std::string& text)
{
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    } else {
      out += "\\x";
      out += digits[byte >> 4];
      out += digits[byte & 15];
    }
  }
  return out;
}

}  // namespace

std::string Diagnostics::text() const
{
  std::vector<const Problem*> order;
  for (const Problem& problem : problems.list()) order.push_back(&problem);
  std::stable_sort(order.begin(), order.end(), [](const Problem* a, const Problem* b) {
    return a->line > 0 && (b->line == 0 || a->line < b->line);
  });
  std::string out;
  for (const Problem* problem : order) {
    const bool set_on_command_line =
        problem->line == 0 && std::any_of(overridden.begin(), overridden.end(), [&](const std::string& root) {
          return pointer_within(problem->pointer, root);
        });
    if (!out.empty()) out += '\n';
    if (set_on_command_line)
      out += "command line";
    else
      out += file + (problem->line > 0 ? ":" + std::to_string(problem->line) : "");
    if (!problem->pointer.empty()) out += ": " + printable(problem->pointer);
    out += ": " + printable(problem->message);
  }
  return out;
}

}  // namespace hauberk
