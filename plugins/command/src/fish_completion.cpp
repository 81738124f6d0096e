#include "commands.hpp"
#include "completion.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hauberk::command {
namespace {

constexpr std::string_view frame =
    R"(# Completion of hauberk for fish, as `hauberk completion fish` prints it.

# The command of the line: run, plugins new, or nothing.
function __hauberk_command
    set -l words (commandline -opc)
    if set -q words[3]
        switch "$words[2] $words[3]"
            case @LONG@
                echo "$words[2] $words[3]"
                return
        end
    end
    echo "$words[2]"
end

function __hauberk_is
    test (__hauberk_command) = "$argv[1]"
end

function __hauberk_plugins
    command hauberk plugins list 2>/dev/null | @FILTER@
end

complete -c hauberk -f
complete -c hauberk -n '__hauberk_is ""' -s h -l help -d 'show this and exit'
complete -c hauberk -n '__hauberk_is ""' -l version -d 'show the version and exit'
@COMMANDS@)";

/// What offers words, as the argument of -a; empty where nothing is.
std::string offer(Offer what, const std::vector<std::string>& words)
{
  switch (what) {
    case Offer::nothing:
      return "";
    case Offer::words:
      return fmt::format("{}", fmt::join(words, " "));
    case Offer::experiments:
    case Offer::results:
      return "(__fish_complete_suffix .json)";
    case Offer::folders:
      return "(__fish_complete_directories)";
    case Offer::files:
      return "(__fish_complete_path)";
    case Offer::libraries:
      return "(__fish_complete_suffix .so)";
    case Offer::plugins:
      return "(__hauberk_plugins)";
  }
  return "";
}

/// The beginning of a line that holds for one command.
std::string line_of(const std::string& name, const std::string& also = "")
{
  return fmt::format("complete -c hauberk -n {}",
                     shell_quoted(fmt::format("__hauberk_is \"{}\"{}", name, also)));
}

std::string option_line(const Description& about, const Option& option)
{
  std::string text = line_of(about.name);
  if (option.letter != 0) text += fmt::format(" -s {}", option.letter);
  text += " -l " + option.name;
  if (option.takes != Takes::nothing) text += " -x";
  const std::string values = offer(option.offer, option.choices);
  if (!values.empty()) text += " -a " + shell_quoted(values);
  return fmt::format("{} -d {}\n", text, shell_quoted(option.help));
}

std::string lines_of(const Description& about)
{
  std::string text;
  if (!is_below_another(about))
    text += fmt::format("{} -a {} -d {}\n", line_of(""), about.name, shell_quoted(about.line));
  for (const Option& option : options_with_help(about)) text += option_line(about, option);
  for (std::size_t k = 0; k < about.arguments.size(); ++k) {
    const Argument& argument = about.arguments[k];
    const std::vector<std::string> words = k == 0 ? first_words(about) : argument.choices;
    const std::string offered = offer(argument.offer, words);
    // Fish does not count arguments: words are offered until one of them stands there.
    std::string also;
    if (argument.offer == Offer::words)
      also = fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(words, " "));
    if (!argument.after.empty()) also = "; and __fish_seen_subcommand_from " + argument.after;
    if (!offered.empty())
      text += fmt::format("{} -k -a {}\n", line_of(about.name, also), shell_quoted(offered));
  }
  return text;
}

}  // namespace

std::string fish_completion()
{
  std::vector<std::string> two_words;
  std::string lines;
  for (const Command& command : commands()) {
    if (is_below_another(command.about)) two_words.push_back(shell_quoted(command.about.name));
    lines += lines_of(command.about);
  }
  std::string text = with_part(std::string(frame), "@LONG@", fmt::format("{}", fmt::join(two_words, " ")));
  text = with_part(text, "@FILTER@", ids_filter());
  return with_part(text, "@COMMANDS@", lines);
}

}  // namespace hauberk::command
