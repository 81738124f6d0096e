/// Every command and every option that a parser takes is in the manual page, in the completion of every shell
/// and in share/doc/command.md. Run with HAUBERK_UPDATE=1 in the environment to write the tables of that page
/// anew.

#include "commands.hpp"
#include "completion.hpp"
#include "man_page.hpp"
#include "options.hpp"
#include "reference.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/experiment.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace hauberk::command {
namespace {

/// From `begin` to the next `end`; empty where there is none.
std::string part(const std::string& text, const std::string& begin, const std::string& end)
{
  const std::size_t at = text.find(begin);
  return at == std::string::npos ? "" : text.substr(at, text.find(end, at + begin.size()) - at);
}

std::string lines_with(const std::string& text, const std::string& what)
{
  std::istringstream lines(text);
  std::string found;
  for (std::string line; std::getline(lines, line);)
    if (line.find(what) != std::string::npos) found += line + "\n";
  return found;
}

/// Long names of the options that the parser has: boost prints them from its own table.
std::vector<std::string> options_of_parser(const Description& about)
{
  std::istringstream lines(Options(about).usage());
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  -")) continue;
    const std::size_t at = line.find("--");
    names.push_back(line.substr(at, line.find_first_of(" ", at) - at));
  }
  return names;
}

void expect_in(const std::string& text, const std::string& what, const std::string& where)
{
  EXPECT_NE(text.find(what), std::string::npos) << what << " is not in " << where << ":\n" << text;
}

std::string block(const std::string& name)
{
  for (const ReferenceBlock& block : reference_blocks())
    if (block.name == name) return block.markdown;
  return "";
}

TEST(Pages, CommandsOfTheProgram)
{
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.about.name);
  EXPECT_EQ(names, (std::vector<std::string>{"run", "check", "plan", "room", "gather", "submit", "verify",
                                             "report", "export", "inspect", "weave", "plugins",
                                             "plugins conform", "plugins new", "completion", "man"}));
}

TEST(Pages, EveryCommandIsOnThem)
{
  const std::string help = overview(), bash = bash_completion(), zsh = zsh_completion(),
                    fish = fish_completion();
  for (const Command& command : commands()) {
    const Description& about = command.about;
    expect_in(man_page(), fmt::format("\n.SS hauberk {}\n", roff(about.synopsis)), "the manual page");
    expect_in(block("options of " + about.name), fmt::format("`hauberk {}`", about.synopsis), "command.md");
    expect_in(bash, fmt::format("\n    '{}') options=(", about.name), "the completion of bash");
    expect_in(zsh, fmt::format("\n        '{}')\n", about.name), "the completion of zsh");
    expect_in(fish, fmt::format("'__hauberk_is \"{}\"'", about.name), "the completion of fish");
    if (is_below_another(about)) continue;
    expect_in(help, fmt::format("\n  hauberk {}", about.name), "--help");
    expect_in(part(bash, "((COMP_CWORD == 1))", "return"), " " + about.name + " ", "the first words of bash");
    expect_in(part(zsh, "commands=(", "\n  )"), fmt::format("\n    '{}:", about.name), "the commands of zsh");
    expect_in(fish, fmt::format("'__hauberk_is \"\"' -a {} ", about.name), "the commands of fish");
  }
}

TEST(Pages, EveryOptionOfAParserIsOnThem)
{
  std::size_t count = 0;
  for (const Command& command : commands()) {
    const Description& about = command.about;
    const std::string name = about.name;
    const std::string man = part(man_page(), fmt::format("\n.SS hauberk {}\n", roff(about.synopsis)), "\n.S");
    const std::string bash = part(bash_completion(), fmt::format("\n    '{}') options=(", name), ")");
    const std::string zsh = part(zsh_completion(), fmt::format("\n        '{}')\n", name), ";;");
    const std::string fish = lines_with(fish_completion(), fmt::format("'__hauberk_is \"{}\"'", name));
    for (const std::string& option : options_of_parser(about)) {
      ++count;
      expect_in(bash + " ", option + " ", "the completion of bash for " + name);
      expect_in(zsh, option, "the completion of zsh for " + name);
      expect_in(fish, fmt::format(" -l {} ", option.substr(2)), "the completion of fish for " + name);
      if (option == "--help") continue;  // of every command, said once
      expect_in(man, "\\fB" + roff(option) + "\\fR", "the manual page of " + name);
      expect_in(block("options of " + name), "`" + option, "command.md for " + name);
    }
  }
  EXPECT_GT(count, 40U);
}

TEST(Pages, EveryOptionIsParsed)
{
  for (const Command& command : commands())
    EXPECT_EQ(options_of_parser(command.about).size(), command.about.options.size() + 1)
        << command.about.name;
}

TEST(Pages, ReferenceIsUpToDate)
{
  const std::string path = HAUBERK_SOURCE_DIR "/share/doc/command.md";
  const std::string page = read_text_file(path);
  const std::string text = with_blocks(page, reference_blocks());
  if (std::getenv("HAUBERK_UPDATE") != nullptr) std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(read_text_file(path), text) << path << " is out of date: run this test with HAUBERK_UPDATE=1";
}

std::string problem_of(const std::string& page)
{
  try {
    return with_blocks(page, {{"one", "1\n"}, {"two", "2\n"}});
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Pages, BlocksAreReplacedEachOnce)
{
  const std::string one = "<!-- begin: one -->\nold\n<!-- end -->\n",
                    two = "<!-- begin: two -->\n<!-- end -->\n";
  EXPECT_EQ(problem_of("a\n" + two + "b\n" + one + "c\n"),
            "a\n<!-- begin: two -->\n2\n<!-- end -->\nb\n<!-- begin: one -->\n1\n<!-- end -->\nc\n");
  EXPECT_EQ(problem_of(one), "expected once: <!-- begin: two -->\n...\n<!-- end -->\n");
  EXPECT_EQ(problem_of(one + two + one), "expected once: <!-- begin: one -->\n...\n<!-- end -->\n");
  EXPECT_EQ(problem_of(one + two + "<!-- begin: three -->\n<!-- end -->\n"), "expected 2 blocks, found 3");
}

TEST(Pages, CommandsOfTwoWords)
{
  EXPECT_EQ(find_command({"plugins", "new", "x"})->about.name, "plugins new");
  EXPECT_EQ(find_command({"plugins", "list"})->about.name, "plugins");
  EXPECT_EQ(find_command({"plugins"})->about.name, "plugins");
  EXPECT_EQ(find_command({"plugins new"}), nullptr);
  EXPECT_EQ(find_command({"new"}), nullptr);
  EXPECT_EQ(find_command({}), nullptr);
}

TEST(Pages, RoffShowsEveryLetter)
{
  EXPECT_EQ(roff("../x -o '\\d' `a`^~\""), "\\&../x \\-o \\(aq\\(rsd\\(aq \\(gaa\\(ga\\(ha\\(ti\\(dq");
  EXPECT_EQ(roff("'x'"), "\\(aqx\\(aq");
}

}  // namespace
}  // namespace hauberk::command
