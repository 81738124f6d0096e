/// share/doc/tutorial.md: its files are right, and its commands print what it shows.

#include "program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace hauberk::test {
namespace {

using Lines = std::vector<std::string>;

/// A fenced block of the page: "```LANGUAGE NAME", lines, "```".
struct Block {
  std::string language, name;
  Lines lines;
};

/// What the page says about a command: "$ hauberk ...", what it prints, and "$ echo $?" unless that is 0.
struct Command {
  Lines arguments, shown;
  int code = 0;
};

Lines split(const std::string& text, char separator)
{
  Lines out;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) out.push_back(part);
  return out;
}

/// Without empty ones.
Lines words(const std::string& line)
{
  Lines out;
  std::istringstream in(line);
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::vector<Block> page_blocks()
{
  std::vector<Block> blocks;
  bool inside = false;
  for (const std::string& line : split(read_text(HAUBERK_SOURCE_DIR "/share/doc/tutorial.md"), '\n')) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (!inside) continue;
      Lines head = words(line.substr(3));
      head.resize(2);
      blocks.push_back({head[0], head[1], {}});
    } else if (inside) {
      blocks.back().lines.push_back(line);
    }
  }
  return blocks;
}

std::string file_text(const Block& block)
{
  std::string text;
  for (const std::string& line : block.lines) text += line + "\n";
  return text;
}

/// Arguments of a command line; quotes only keep the shell away, and no argument holds a space.
Lines arguments_of(std::string line)
{
  std::erase(line, '\'');
  Lines out = words(line);
  out.erase(out.begin(), out.begin() + 2);  // $ hauberk
  return out;
}

std::vector<Command> commands_of(const Block& block)
{
  std::vector<Command> out;
  bool ours = false;
  for (std::size_t k = 0; k < block.lines.size(); ++k) {
    std::string line = block.lines[k];
    while (line.ends_with('\\') && k + 1 < block.lines.size())
      line = line.substr(0, line.size() - 1) + block.lines[++k];
    if (line == "$ echo $?") {
      if (!out.empty() && k + 1 < block.lines.size()) out.back().code = std::stoi(block.lines[++k]);
    } else if (line.starts_with("$ ")) {
      ours = line.starts_with("$ hauberk ");
      if (ours) out.push_back({arguments_of(line), {}, 0});
    } else if (ours) {
      out.back().shown.push_back(line);
    }
  }
  return out;
}

/// Words must be equal, but numbers in them may differ a little: builds round differently.
bool same_word(const std::string& shown, const std::string& printed)
{
  if (shown == printed) return true;
  char *rest_shown = nullptr, *rest_printed = nullptr;
  const double a = std::strtod(shown.c_str(), &rest_shown), b = std::strtod(printed.c_str(), &rest_printed);
  if (rest_shown == shown.c_str() || rest_printed == printed.c_str()) return false;
  return std::string(rest_shown) == rest_printed && std::abs(a - b) <= 1e-5 + 1e-3 * std::abs(a);
}

/// A line that is shown up to " ..." may go on.
bool same_line(const std::string& shown, const std::string& printed)
{
  Lines a = words(shown), b = words(printed);
  if (!a.empty() && a.back() == "...") {
    a.pop_back();
    if (b.size() > a.size()) b.resize(a.size());
  }
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same_word);
}

/// All that is shown was printed, in this order; "..." stands for anything.
void expect_shown(const Lines& shown, const std::string& printed)
{
  const Lines lines = split(printed, '\n');
  auto at = lines.begin();
  for (const std::string& line : shown) {
    if (line == "...") continue;
    const auto found =
        std::find_if(at, lines.end(), [&line](const std::string& p) { return same_line(line, p); });
    if (found == lines.end()) {
      ADD_FAILURE() << "the tutorial shows\n" << line << "\nbut the program prints\n" << printed;
      return;
    }
    at = found + 1;
  }
}

std::string without(std::string text, const std::string& what)
{
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at))
    text.erase(at, what.size());
  return text;
}

class Tutorial : public ::testing::Test {
 protected:
  void SetUp() override
  {
    for (const Block& block : page_blocks()) {
      if (block.language == "jsonc") files_.push_back(folder_.write(block.name, file_text(block)));
      if (block.language != "console") continue;
      for (const Command& c : commands_of(block)) commands_.push_back(c);
    }
    ASSERT_EQ(files_.size(), 4U);
    ASSERT_GT(commands_.size(), 15U);
  }

  /// The page's paths are relative to its reader's folder.
  std::string in_folder(const std::string& argument) const
  {
    return argument.ends_with(".json") || argument.starts_with("out/") ? folder_ / argument : argument;
  }

  WorkFolder folder_;
  Lines files_;
  std::vector<Command> commands_;
};

TEST_F(Tutorial, FilesHaveNoProblems)
{
  for (const std::string& file : files_) {
    const Outcome o = run_program({"check", file, "--thorough"});
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out.find(file + ": no problems; "), 0U) << o.out;
  }
}

TEST_F(Tutorial, CommandsPrintWhatIsShown)
{
  for (const Command& c : commands_) {
    Lines arguments;
    std::string line;
    for (const std::string& a : c.arguments) {
      arguments.push_back(in_folder(a));
      line += " " + a;
    }
    SCOPED_TRACE("hauberk" + line);
    const Outcome o = run_program(arguments);
    EXPECT_EQ(o.code, c.code) << o.out << o.err;
    expect_shown(c.shown, without(o.err + o.out, folder_.path().string() + "/"));
  }
}

}  // namespace
}  // namespace hauberk::test
