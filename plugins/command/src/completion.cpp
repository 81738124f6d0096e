#include "completion.hpp"
#include <algorithm>
#include <cctype>

#include "commands.hpp"

namespace hauberk::command {

std::vector<Option> options_with_help(const Description& about)
{
  return joined(about.options, {help_option()});
}

std::vector<std::string> spellings(const Option& option)
{
  std::vector<std::string> words{"--" + option.name};
  if (option.letter != 0) words.push_back({'-', option.letter});
  return words;
}

std::vector<std::string> first_words(const Description& about)
{
  std::vector<std::string> words;
  if (!about.arguments.empty()) words = about.arguments.front().choices;
  for (const std::string& word : words_below(about)) words.push_back(word);
  return words;
}

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

std::string ids_filter() { return "sed -nE 's/^([a-z0-9_]+) +(shape|load case|optimizer) .*/\\1/p'"; }

std::string with_part(std::string text, std::string_view mark, const std::string& part)
{
  return text.replace(text.find(mark), mark.size(), part);
}

}  // namespace hauberk::command
