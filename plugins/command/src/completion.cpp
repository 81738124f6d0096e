#include "completion.hpp"
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

std::string ids_filter() { return "sed -nE 's/^([a-z0-9_]+) +(shape|load case|optimizer) .*/\\1/p'"; }

std::string with_part(std::string text, std::string_view mark, const std::string& part)
{
  return text.replace(text.find(mark), mark.size(), part);
}

}  // namespace hauberk::command
