#include "shell_words.hpp"

#include <algorithm>
#include <cctype>

namespace hauberk::command {

std::string shell_quoted(std::string_view text)
{
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string shell_word(std::string_view text)
{
  static constexpr std::string_view harmless = "_./=:+-@%,";
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || harmless.find(c) != std::string_view::npos;
  });
  return plain ? std::string(text) : shell_quoted(text);
}

}  // namespace hauberk::command
