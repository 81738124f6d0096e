#include "commands.hpp"
#include "completion.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

namespace hauberk::command {
namespace {

/// What does not depend on the commands. `=` is a word of its own to bash, so that the value of an option may
/// come in parts: --set /solver/preset = acc.
constexpr std::string_view frame =
    R"(# Completion of hauberk for bash, as `hauberk completion bash` prints it.

# Offers those of the words that begin with what is there.
_hauberk_words() {
  local candidate
  for candidate in "$@"; do
    [[ $candidate == "$before$word"* ]] || continue
    COMPREPLY+=("${candidate#"$before"}")
    [[ $candidate != *= ]] || compopt -o nospace 2>/dev/null
  done
}

# Offers folders, and with arguments files that match the pattern.
_hauberk_paths() {
  local found plain=${word//\\/}
  plain=${plain#[\"\']}
  compopt -o filenames 2>/dev/null
  while IFS= read -r found; do COMPREPLY+=("$found"); done < <(
    {
      compgen -d -- "$plain"
      if (($# > 0)); then compgen -f -X "!$1" -- "$plain"; fi
    } | sort -u
  )
}

_hauberk_plugins() {
  local -a found
  mapfile -t found < <("${COMP_WORDS[0]}" plugins list 2>/dev/null | @FILTER@)
  _hauberk_words "${found[@]}"
}

_hauberk() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} at=2
  local option= before= first= count=0 current i
  local -a options
  local valued
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _hauberk_words @COMMANDS@
    return
  fi
  if ((COMP_CWORD > 2)); then
    case "$command ${COMP_WORDS[2]}" in
      @LONG@) command+=" ${COMP_WORDS[2]}" at=3 ;;
    esac
  fi
  case $command in
@OPTIONS@    *) return ;;
  esac

  # The words before: arguments are counted, `option` is what the value that is typed belongs to.
  for ((i = at; i < COMP_CWORD; ++i)); do
    current=${COMP_WORDS[i]}
    if [[ -n $option && $current == = ]]; then
      [[ -z $before ]] || before+==
    elif [[ -n $option && (-z $before || $before == *=) ]]; then
      before+=$current
    elif [[ $valued == *" $current "* ]]; then
      option=$current before=
    else
      option= before=
      if [[ $current != -* ]]; then
        ((count > 0)) || first=$current
        ((++count))
      fi
    fi
  done
  if [[ -n $option && $word == = ]]; then
    [[ -z $before ]] || before+==
    word=
  elif [[ -n $before && $before != *= ]]; then
    option= before=
  fi

  case "$command $option" in
@VALUES@  esac
  [[ -z $option ]] || return
  if [[ $word != -* ]]; then
    case "$command $count" in
@ARGUMENTS@    esac
  fi
  _hauberk_words "${options[@]}"
}

complete -F _hauberk hauberk
)";

std::string quoted_list(const std::vector<std::string>& words)
{
  std::vector<std::string> list;
  for (const std::string& word : words) list.push_back(shell_quoted(word));
  return fmt::format("{}", fmt::join(list, " "));
}

/// The call that offers words; empty where nothing is.
std::string offer(Offer what, const std::vector<std::string>& words)
{
  switch (what) {
    case Offer::nothing:
      return "";
    case Offer::words:
      return "_hauberk_words " + quoted_list(words);
    case Offer::experiments:
    case Offer::results:
      return "_hauberk_paths '*.json'";
    case Offer::folders:
      return "_hauberk_paths";
    case Offer::files:
      return "_hauberk_paths '*'";
    case Offer::libraries:
      return "_hauberk_paths '*.so'";
    case Offer::plugins:
      return "_hauberk_plugins";
  }
  return "";
}

std::string options_of(const Description& about)
{
  std::vector<std::string> all, valued;
  for (const Option& option : options_with_help(about)) {
    for (const std::string& word : spellings(option)) {
      all.push_back(word);
      if (option.takes != Takes::nothing) valued.push_back(word);
    }
  }
  return fmt::format("    {}) options=({}) valued={} ;;\n", shell_quoted(about.name), fmt::join(all, " "),
                     shell_quoted(fmt::format(" {} ", fmt::join(valued, " "))));
}

/// Adds the values of a command's options: what offers them, and the patterns "run --set" that it is for.
void add_values(const Description& about, std::map<std::string, std::vector<std::string>>& patterns)
{
  for (const Option& option : about.options) {
    const std::string call = offer(option.offer, option.choices);
    if (call.empty()) continue;
    for (const std::string& word : spellings(option))
      patterns[call].push_back(shell_quoted(about.name + " " + word));
  }
}

std::string arguments_of(const Description& about)
{
  std::string text;
  for (std::size_t k = 0; k < about.arguments.size(); ++k) {
    const Argument& argument = about.arguments[k];
    std::string call = offer(argument.offer, k == 0 ? first_words(about) : argument.choices);
    if (call.empty()) continue;
    call += "; return";
    if (!argument.after.empty())
      call = fmt::format("if [[ $first == {} ]]; then {}; fi", argument.after, call);
    const std::string place = argument.several ? " '*" : fmt::format(" {}'", k);
    text += fmt::format("      '{}{}) {} ;;\n", about.name, place, call);
  }
  return text;
}

}  // namespace

std::string bash_completion()
{
  std::vector<std::string> names, two_words;
  std::string options, values, arguments;
  std::map<std::string, std::vector<std::string>> patterns;
  for (const Command& command : commands()) {
    const Description& about = command.about;
    (is_below_another(about) ? two_words : names)
        .push_back(is_below_another(about) ? shell_quoted(about.name) : about.name);
    options += options_of(about);
    add_values(about, patterns);
    arguments += arguments_of(about);
  }
  for (const auto& [call, options_of_it] : patterns)
    values += fmt::format("    {})\n      {} ;;\n", fmt::join(options_of_it, " | "), call);
  std::string text = with_part(std::string(frame), "@FILTER@", ids_filter());
  text = with_part(text, "@COMMANDS@", fmt::format("{} --help --version", fmt::join(names, " ")));
  text = with_part(text, "@LONG@", fmt::format("{}", fmt::join(two_words, " | ")));
  text = with_part(text, "@OPTIONS@", options);
  text = with_part(text, "@VALUES@", values);
  return with_part(text, "@ARGUMENTS@", arguments);
}

}  // namespace hauberk::command
