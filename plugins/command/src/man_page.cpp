#include "man_page.hpp"

#include "commands.hpp"

#include <hauberk/version.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace hauberk::command {
namespace {

std::string escaped(char c)
{
  switch (c) {
    case '\\':
      return "\\(rs";
    case '\'':
      return "\\(aq";
    case '"':
      return "\\(dq";
    case '-':  // a minus, which can be copied into a terminal, not a hyphen
      return "\\-";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return {c};
  }
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// Sentences, in which `literal` is bold.
std::string prose(const std::string& text)
{
  std::string out;
  bool literal = false;
  for (std::size_t at = 0; at <= text.size(); literal = !literal) {
    const std::size_t end = std::min(text.find('`', at), text.size());
    const std::string part = text.substr(at, end - at);
    if (!part.empty()) out += literal ? bold(part) : roff(part);
    at = end + 1;
  }
  return out + "\n";
}

std::string item(const std::string& head, const std::string& meaning)
{
  return ".TP\n" + head + "\n" + prose(meaning);
}

/// -o DIR, --output DIR
std::string forms(const Option& option)
{
  const std::string value = option.takes == Takes::nothing ? "" : " " + italic(option.value);
  const std::string letter = option.letter != 0 ? bold(fmt::format("-{}", option.letter)) + value + ", " : "";
  return letter + bold("--" + option.name) + value;
}

std::string option_item(const Option& option)
{
  return item(forms(option), option.more.empty() ? option.help : option.help + ". " + option.more);
}

std::string command_section(const Description& about)
{
  std::string text = fmt::format(".SS hauberk {}\n{}", roff(about.synopsis), prose(about.summary));
  if (!about.more.empty()) text += ".PP\n" + prose(about.more);
  for (const Option& option : about.options) text += option_item(option);
  return text;
}

std::string section(const std::string& title, const std::vector<Entry>& entries)
{
  std::string text = ".SH " + title + "\n";
  for (const Entry& entry : entries) text += item(bold(entry.name), entry.meaning);
  return text;
}

std::string synopsis()
{
  std::string text = ".SH SYNOPSIS\n";
  for (const Command& command : commands())
    text += fmt::format("{} {}\n.br\n", bold("hauberk"), roff(command.about.synopsis));
  return text + bold("hauberk") + " " + bold("--version") + " | " + bold("--help") + "\n";
}

}  // namespace

std::string roff(const std::string& text)
{
  std::string out;
  for (const char c : text) {
    if (c == '.' && out.empty()) out += "\\&";  // otherwise a request
    out += escaped(c);
  }
  return out;
}

std::string man_page()
{
  std::vector<Entry> codes;
  for (const ExitCode& code : exit_codes()) codes.push_back({std::to_string(code.code), code.meaning});
  std::string text = fmt::format(
      ".TH HAUBERK 1 \"\" \"Hauberk {}\" \"User Commands\"\n.nh\n.ad l\n"
      ".SH NAME\nhauberk \\- deformation limits of generalised chainmail\n",
      version);
  text += synopsis();
  text += ".SH DESCRIPTION\n" + purpose() +
          ".PP\nProgress and errors go to standard error, summaries and answers to standard output.\n";
  text += ".SH COMMANDS\nEvery command has " + forms(help_option()) + ".\n";
  for (const Command& command : commands()) text += command_section(command.about);
  text += section("EXIT STATUS", codes) + section("ENVIRONMENT", environment()) + section("FILES", files());
  text +=
      ".SH EXAMPLES\n.EX\nhauberk check chain.json\nhauberk run chain.json \\-o out/chain\n"
      "hauberk verify out/chain\nhauberk report out/chain \\-o out/report\n.EE\n";
  return text;
}

}  // namespace hauberk::command
