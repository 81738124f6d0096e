#include "document/plain_text.hpp"

#include "document/utf8.hpp"

#include <fmt/format.h>

namespace hauberk {
namespace {

bool acts(unsigned code, LineBreaks line_breaks)
{
  if (code == '\t' || (code == '\n' && line_breaks == LineBreaks::kept)) return false;
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

unsigned code_point(std::string_view character)
{
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(character[k]); };
  switch (character.size()) {
    case 1:
      return byte(0);
    case 2:
      return (byte(0) & 0x1fU) << 6U | (byte(1) & 0x3fU);
    case 3:
      return (byte(0) & 0x0fU) << 12U | (byte(1) & 0x3fU) << 6U | (byte(2) & 0x3fU);
    default:
      return (byte(0) & 0x07U) << 18U | (byte(1) & 0x3fU) << 12U | (byte(2) & 0x3fU) << 6U |
             (byte(3) & 0x3fU);
  }
}

std::string shown(unsigned code)
{
  return code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
}

/// `shown` writes what acts.
template <class Shown>
std::string without_acting(std::string_view text, LineBreaks line_breaks, const Shown& shown)
{
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    const std::string_view character = text.substr(0, length);
    if (find_invalid_utf8(character)) {
      out += shown(first);
      text.remove_prefix(1);
      continue;
    }
    const unsigned code = code_point(character);
    if (acts(code, line_breaks))
      out += shown(code);
    else
      out += character;
    text.remove_prefix(length);
  }
  return out;
}

}  // namespace

std::string plain_text(std::string_view text, LineBreaks line_breaks)
{
  return without_acting(text, line_breaks, shown);
}

std::string plain_json(std::string_view text)
{
  return without_acting(text, LineBreaks::kept, [](unsigned code) { return fmt::format("\\u{:04x}", code); });
}

}  // namespace hauberk
