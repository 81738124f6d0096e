#include "commands.hpp"
#include "completion.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hauberk::command {
namespace {

constexpr std::string_view frame = R"zsh(#compdef hauberk
# Completion of hauberk for zsh, as `hauberk completion zsh` prints it.

_hauberk_plugins() {
  local -a found
  [[ -z $1 || $words[(r)$1] == $1 ]] || return 1
  found=(${(f)"$(_call_program plugins hauberk plugins list 2>/dev/null | @FILTER@)"})
  compadd -a found
}

_hauberk() {
  local curcontext=$curcontext state line command
  typeset -A opt_args
  local -a commands
  commands=(
@COMMANDS@  )
  _arguments -C '(- : *)'{-h,--help}'[show this and exit]' '(- : *)--version[show the version and exit]' \
    '1:command:->command' '*::argument:->argument' && return
  case $state in
    command) _describe command commands ;;
    argument)
      command=$words[1]
      if ((CURRENT > 2)); then
        case "$command $words[2]" in
          @LONG@)
            command+=" $words[2]"
            shift words
            ((CURRENT--))
            ;;
        esac
      fi
      case $command in
@ARGUMENTS@      esac
      ;;
  esac
}

if [[ $funcstack[1] == _hauberk ]]; then
  _hauberk "$@"
else
  compdef _hauberk hauberk
fi
)zsh";

/// With a backslash before each of `marks`.
std::string marked(const std::string& text, std::string_view marks)
{
  std::string out;
  for (const char c : text) {
    if (marks.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// The action of _arguments that offers words.
std::string action(Offer what, const std::vector<std::string>& words, const std::string& after)
{
  switch (what) {
    case Offer::nothing:
      return " ";
    case Offer::words:
      return fmt::format("({})", marked(fmt::format("{}", fmt::join(words, " ")), ":"));
    case Offer::experiments:
    case Offer::results:
      return "_files -g \"*.json\"";
    case Offer::folders:
      return "_files -/";
    case Offer::files:
      return "_files";
    case Offer::libraries:
      return "_files -g \"*.so\"";
    case Offer::plugins:
      return "{_hauberk_plugins " + after + "}";
  }
  return "";
}

/// '(-o --output)'{-o+,--output=}'[folder]:DIR:_files -/'
std::string option_spec(const Option& option)
{
  const std::vector<std::string> words = spellings(option);
  const bool repeats = option.takes == Takes::texts;
  const bool valued = option.takes != Takes::nothing;
  std::string rest = "[" + marked(option.help, "[]\\") + "]";
  if (valued)
    rest += fmt::format(":{}:{}", marked(option.value, ":"), action(option.offer, option.choices, ""));
  std::string names = fmt::format("--{}{}", option.name, valued ? "=" : "");
  const std::string before = repeats                 ? "*"
                             : option.name == "help" ? "(- : *)"
                                                     : fmt::format("({})", fmt::join(words, " "));
  if (option.letter == 0) return shell_quoted(before + names + rest);
  return fmt::format("{}{{-{}{},{}}}{}", shell_quoted(before), option.letter, valued ? "+" : "", names,
                     shell_quoted(rest));
}

std::string argument_spec(const Description& about, std::size_t k)
{
  const Argument& argument = about.arguments[k];
  const std::string place = argument.several ? "*" : std::to_string(k + 1);
  return shell_quoted(
      fmt::format("{}:{}:{}", place, marked(argument.name, ":"),
                  action(argument.offer, k == 0 ? first_words(about) : argument.choices, argument.after)));
}

std::string arguments_of(const Description& about)
{
  std::string text = fmt::format("        {})\n          _arguments", shell_quoted(about.name));
  for (const Option& option : options_with_help(about)) text += " \\\n            " + option_spec(option);
  for (std::size_t k = 0; k < about.arguments.size(); ++k)
    text += " \\\n            " + argument_spec(about, k);
  return text + "\n          ;;\n";
}

}  // namespace

std::string zsh_completion()
{
  std::vector<std::string> two_words;
  std::string names, arguments;
  for (const Command& command : commands()) {
    const Description& about = command.about;
    if (is_below_another(about))
      two_words.push_back(shell_quoted(about.name));
    else
      names += fmt::format("    {}\n", shell_quoted(about.name + ":" + marked(about.line, ":")));
    arguments += arguments_of(about);
  }
  std::string text = with_part(std::string(frame), "@FILTER@", ids_filter());
  text = with_part(text, "@COMMANDS@", names);
  text = with_part(text, "@LONG@", fmt::format("{}", fmt::join(two_words, " | ")));
  return with_part(text, "@ARGUMENTS@", arguments);
}

}  // namespace hauberk::command
