#include "commands.hpp"

#include "dispatch.hpp"

#include <fmt/format.h>

#include <sstream>
#include <utility>

namespace hauberk::command {
namespace {

/// Words in lines of at most `width` letters.
std::string filled(const std::string& words, std::size_t width)
{
  std::istringstream in(words);
  std::string text, line;
  for (std::string word; in >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > width) text += std::exchange(line, "") + "\n";
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + "\n";
}

}  // namespace

const std::vector<Command>& commands()
{
  static const std::vector<Command> table{
      {run_description(), run_command},
      {check_description(), check_command},
      {plan_description(), plan_command},
      {room_description(), room_command},
      {gather_description(), gather_command},
      {submit_description(), submit_command},
      {verify_description(), verify_command},
      {report_description(), report_command},
      {export_description(), export_command},
      {inspect_description(), inspect_command},
      {weave_description(), weave_command},
      {plugins_description(), plugins_command},
      {conform_description(), conform_command},
      {new_description(), new_command},
      {completion_description(), completion_command},
      {man_description(), man_command},
  };
  return table;
}

const Command* find_command(const std::vector<std::string>& words)
{
  const Command* found = nullptr;
  for (const Command& command : commands()) {
    const std::string& name = command.about.name;
    const std::size_t length = is_below_another(command.about) ? 2 : 1;
    if (words.size() < length) continue;
    if (name == (length == 2 ? words[0] + " " + words[1] : words[0]))
      found = &command;  // the longer comes last
  }
  return found;
}

bool is_below_another(const Description& command) { return command.name.find(' ') != std::string::npos; }

std::vector<std::string> words_below(const Description& command)
{
  std::vector<std::string> words;
  for (const Command& other : commands())
    if (other.about.name.starts_with(command.name + " "))
      words.push_back(other.about.name.substr(command.name.size() + 1));
  return words;
}

std::string purpose()
{
  return "Deformation limits of discrete interlocking materials: how far a fabric of linked rigid elements\n"
         "stretches and compresses before contact locks it, and element shapes that have the limits you "
         "want.\n";
}

std::vector<ExitCode> exit_codes()
{
  return {
      {exit_done, "done",
       "done; directions that links leave `unbounded` or `not_attained`, and patches that are "
       "`not_a_sheet` before they lock, are answers"},
      {exit_failed, "the computation failed, what was computed is on disk",
       "the computation failed, or an `expect` of the experiment is missed, or `verify` or `plugins "
       "conform` found something wrong, or `gather` lacks parts; what was computed is on disk"},
      {exit_bad_input, "bad input, nothing written",
       "bad input or a wrong command line; nothing was written"},
      {exit_interrupted, "interrupted, partial results are on disk",
       "interrupted; partial results are on disk, if anything was computed yet. `room` then prints, and writes with `-o`, the best "
       "state so far"}};
}

std::vector<Entry> environment()
{
  return {{"HAUBERK_PLUGIN_PATH",
           "absolute folders, separated by colons, that are searched for plugins after those of "
           "`--plugin-path` and before the program's own"},
          {"TMPDIR",
           "where `run` puts final results in a new folder when they cannot be written to theirs; default "
           "`/tmp`"},
          {"TERM",
           "on a terminal progress is redrawn in place, unless this is `dumb` or not set: then it is plain "
           "lines"}};
}

std::vector<Entry> files()
{
  return {{"../lib/hauberk/plugins", "from the folder of the program: the plugins that come with it"},
          {"../share/hauberk/weaves", "the library of weaves that experiments name"},
          {"../share/hauberk/experiments", "examples"},
          {"../share/hauberk/schema/experiment.schema.json", "schema of experiment files, for editors"},
          {"out/NAME/results.json", "what `run` computed of NAME.json, with the other files of its task"},
          {".hauberk-previous", "in the folder of results: those of a former run, until the new one is done"},
          {".hauberk-evaluations", "in the folder of a design's results: what `--resume` goes on from"},
          {"parts", "in the folder of results: what the parts of a divided run have found, for `gather`"},
          {".hauberk-digest",
           "in the folder of partial results: what tells `--resume` that they were not changed"},
          {".hauberk-lock", "in the folder of results: the run that writes into it"}};
}

std::string usage_of_all()
{
  std::string text;
  for (const Command& command : commands()) {
    const Description& about = command.about;
    if (is_below_another(about)) continue;
    text += fmt::format("  hauberk {}{}{}\n      {}\n", about.name, about.form.empty() ? "" : " ", about.form,
                        about.line);
  }
  return text +
         "  hauberk --version\n"
         "  hauberk --help; hauberk COMMAND --help for the options of a command\n";
}

std::string overview()
{
  std::string codes;
  for (const ExitCode& code : exit_codes())
    codes += fmt::format("{}{} {}", codes.empty() ? "" : "; ", code.code, code.brief);
  return purpose() + "\nUsage:\n" + usage_of_all() + "\n" + filled("Exit codes: " + codes + ".", 100);
}

}  // namespace hauberk::command
