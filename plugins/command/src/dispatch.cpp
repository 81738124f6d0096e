#include "dispatch.hpp"

#include "options.hpp"
#include "run/prepared.hpp"

#include <hauberk/error.hpp>
#include <hauberk/suggestion.hpp>
#include <hauberk/version.hpp>

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <new>

namespace hauberk::command {
namespace {

struct SubCommand {
  const char* name;
  const char* usage;
  const char* summary;
  int (*run)(const std::vector<std::string>&);
};

constexpr std::array sub_commands{
    SubCommand{"run", "EXPERIMENT.json [-o DIR] [--force] [--threads N] [--set path=value ...]",
               "compute what the experiment asks for", run_command},
    SubCommand{"check", "EXPERIMENT.json", "every problem in the file at once, with its place",
               check_command},
    SubCommand{"plan", "EXPERIMENT.json", "what will be modelled, and why; the rest state", plan_command},
    SubCommand{"room", "EXPERIMENT.json [--starts N] [-o FILE]", "the thickest rings that leave a rest state",
               room_command},
    SubCommand{"verify", "RESULTS.json", "recheck a result from its file alone", verify_command},
    SubCommand{"report", "RESULT... -o DIR [--force] [--recheck FOLDER]",
               "a table and a page of plots of many results", report_command},
    SubCommand{"plugins", "[list | describe ID | conform FILE.so | new NAME DIR]",
               "shapes, load cases and optimizers that are found", plugins_command},
};

std::string help()
{
  std::string text =
      "Deformation limits of discrete interlocking materials: how far a fabric of linked rigid elements\n"
      "stretches and compresses before contact locks it, and element shapes that have the limits you "
      "want.\n\n"
      "Usage:\n";
  for (const SubCommand& c : sub_commands)
    text += fmt::format("  hauberk {} {}\n      {}\n", c.name, c.usage, c.summary);
  text +=
      "  hauberk --version\n"
      "  hauberk --help; hauberk COMMAND --help for the options of a command\n\n"
      "Exit codes: 0 done; 1 the computation failed, what was computed is on disk; 2 bad input, nothing\n"
      "written; 130 interrupted, partial results are on disk.\n";
  return text;
}

int run(const std::vector<std::string>& words)
{
  if (words.empty()) throw UsageError("no command given", help());
  const std::string& name = words.front();
  if (name == "--help" || name == "-h" || name == "help") {
    fmt::print("{}", help());
    return exit_done;
  }
  if (name == "--version") {
    fmt::print("hauberk {} ({})\n", version, build_type);
    return exit_done;
  }
  std::vector<std::string> known;
  for (const SubCommand& c : sub_commands) {
    if (name == c.name) return c.run({words.begin() + 1, words.end()});
    known.emplace_back(c.name);
  }
  throw UsageError(fmt::format("unknown command '{}'{}", name, did_you_mean(name, known)), help());
}

int fail(int code, const std::string& message) noexcept
{
  std::fprintf(stderr, "hauberk: %s\n", message.c_str());
  return code;
}

}  // namespace

int dispatch(const std::vector<std::string>& words) noexcept
{
  try {
    const int code = run(words);
    return std::fflush(stdout) == 0 ? code : fail(exit_failed, "standard output cannot be written");
  } catch (const ShowHelp& shown) {
    fmt::print("{}", shown.text());
    return exit_done;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "hauberk: %s\n\n%s", error.what(), error.usage().c_str());
    return exit_bad_input;
  } catch (const ReportedProblems& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return exit_bad_input;
  } catch (const InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_failed, "out of memory");
  } catch (const std::exception& error) {
    return fail(exit_failed, error.what());
  } catch (...) {
    return fail(exit_failed, "an error that says nothing about itself");
  }
}

}  // namespace hauberk::command
