#include "reference.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

namespace hauberk::command {
namespace {

constexpr std::string_view begin_mark = "<!-- begin: ", end_mark = "<!-- end -->\n";

/// Of a cell of a table: a bar would end it.
std::string cell(const std::string& text)
{
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string sentences(const std::string& first, const std::string& more)
{
  return more.empty() ? first : fmt::format("{}{}{}", first, first.ends_with('.') ? " " : ". ", more);
}

std::string option_row(const Option& option)
{
  const std::string value = option.takes == Takes::nothing ? "" : " " + option.value;
  const std::string letter = option.letter != 0 ? fmt::format("`-{}{}`, ", option.letter, value) : "";
  return fmt::format("| {}`--{}{}` | {} |\n", letter, option.name, value,
                     cell(sentences(option.help, option.more)));
}

ReferenceBlock options_block(const Description& about)
{
  std::string text =
      fmt::format("`hauberk {}`\n\n{}\n", about.synopsis, sentences(about.summary, about.more));
  if (!about.options.empty()) text += "\n| option | meaning |\n| --- | --- |\n";
  for (const Option& option : about.options) text += option_row(option);
  return {"options of " + about.name, text};
}

ReferenceBlock table(const std::string& name, const std::string& head, const std::vector<Entry>& entries)
{
  std::string text = fmt::format("| {} | meaning |\n| --- | --- |\n", head);
  for (const Entry& entry : entries) text += fmt::format("| {} | {} |\n", entry.name, cell(entry.meaning));
  return {name, text};
}

std::vector<Entry> literal(std::vector<Entry> entries)
{
  for (Entry& entry : entries) entry.name = "`" + entry.name + "`";
  return entries;
}

}  // namespace

std::vector<ReferenceBlock> reference_blocks()
{
  std::vector<Entry> codes;
  for (const ExitCode& code : exit_codes()) codes.push_back({std::to_string(code.code), code.meaning});
  std::vector<ReferenceBlock> blocks{{"commands", "```\n" + usage_of_all() + "```\n"},
                                     table("exit codes", "exit code", codes),
                                     table("environment", "variable", literal(environment())),
                                     table("files", "file", literal(files()))};
  for (const Command& command : commands()) blocks.push_back(options_block(command.about));
  return blocks;
}

std::string with_blocks(const std::string& page, const std::vector<ReferenceBlock>& blocks)
{
  std::string text = page;
  std::size_t found = 0;
  for (const ReferenceBlock& block : blocks) {
    const std::string begin = fmt::format("{}{} -->\n", begin_mark, block.name);
    const std::size_t at = text.find(begin);
    const std::size_t end = at == std::string::npos ? at : text.find(end_mark, at);
    if (end == std::string::npos || text.find(begin, at + 1) != std::string::npos)
      throw InputError(fmt::format("expected once: {}...\n{}", begin, end_mark));
    const std::size_t inside = at + begin.size();
    text.replace(inside, end - inside, block.markdown);
  }
  for (std::size_t at = text.find(begin_mark); at != std::string::npos; at = text.find(begin_mark, at + 1))
    ++found;
  if (found != blocks.size())
    throw InputError(fmt::format("expected {} blocks, found {}", blocks.size(), found));
  return text;
}

}  // namespace hauberk::command
