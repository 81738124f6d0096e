#include "completion.hpp"
#include "dispatch.hpp"
#include "options.hpp"

#include <fmt/format.h>

#include <array>

namespace hauberk::command {
namespace {

struct Shell {
  const char* name;
  std::string (*script)();
};

constexpr std::array shells{Shell{"bash", bash_completion}, Shell{"zsh", zsh_completion},
                            Shell{"fish", fish_completion}};

}  // namespace

Description completion_description()
{
  std::vector<std::string> names;
  for (const Shell& shell : shells) names.emplace_back(shell.name);
  return {.name = "completion",
          .form = "bash|zsh|fish",
          .line = "a script that lets a shell complete commands, options and files",
          .synopsis = "completion bash|zsh|fish",
          .summary =
              "Prints the script that lets a shell complete commands, options, files and plugins. It "
              "is installed with the program; a shell that does not look there reads it itself.",
          .arguments = {{.name = "SHELL", .offer = Offer::words, .choices = std::move(names)}}};
}

int completion_command(const std::vector<std::string>& words)
{
  Options options(completion_description());
  options.parse(words);
  for (const Shell& shell : shells) {
    if (options.positional() != shell.name) continue;
    fmt::print("{}", shell.script());
    return exit_done;
  }
  throw UsageError(fmt::format("completion: expected bash, zsh or fish, found '{}'", options.positional()),
                   options.usage());
}

}  // namespace hauberk::command
