#include "dispatch.hpp"

#include "commands.hpp"
#include "options.hpp"
#include "run/prepared.hpp"
#include "say.hpp"

#include <hauberk/error.hpp>
#include <hauberk/suggestion.hpp>
#include <hauberk/version.hpp>

#include <fmt/format.h>

#include <cstdio>
#include <new>

namespace hauberk::command {
namespace {

int run(const std::vector<std::string>& words)
{
  if (words.empty()) throw UsageError("no command given", overview());
  const std::string& name = words.front();
  if (name == "--help" || name == "-h" || name == "help") {
    say("{}", overview());
    return exit_done;
  }
  if (name == "--version") {
    say("hauberk {} ({})\n", version, build_type);
    return exit_done;
  }
  if (const Command* command = find_command(words)) {
    const std::ptrdiff_t length = is_below_another(command->about) ? 2 : 1;
    return command->run({words.begin() + length, words.end()});
  }
  std::vector<std::string> known;
  for (const Command& command : commands())
    if (!is_below_another(command.about)) known.push_back(command.about.name);
  throw UsageError(fmt::format("unknown command '{}'{}", name, did_you_mean(name, known)), overview());
}

/// Help that is asked for is output like any other.
int run_or_show(const std::vector<std::string>& words)
{
  try {
    return run(words);
  } catch (const ShowHelp& shown) {
    say("{}", shown.text());
    return exit_done;
  }
}

int fail(int code, const std::string& message) noexcept
{
  say_error("hauberk: {}\n", message);
  return code;
}

}  // namespace

int dispatch(const std::vector<std::string>& words) noexcept
{
  try {
    const int code = run_or_show(words);
    return std::fflush(stdout) == 0 ? code : fail(exit_failed, "standard output cannot be written");
  } catch (const UsageError& error) {
    say_error("hauberk: {}\n\n{}", error.what(), error.usage());
    return exit_bad_input;
  } catch (const ReportedProblems& error) {
    say_error("{}\n", error.what());
    return exit_bad_input;
  } catch (const InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const std::bad_alloc&) {
    std::fputs("hauberk: out of memory\n", stderr);
    return exit_failed;
  } catch (const std::exception& error) {
    return fail(exit_failed, error.what());
  } catch (...) {
    return fail(exit_failed, "an error that says nothing about itself");
  }
}

}  // namespace hauberk::command
