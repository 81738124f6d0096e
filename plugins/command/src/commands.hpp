#pragma once
/// What users meet of the program: its commands, exit codes, variables of the environment and files.

#include "description.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hauberk::command {

struct Command {
  Description about;
  int (*run)(const std::vector<std::string>& words);
};

/// All commands, in the order in which they are shown; those of two words follow the one of their first.
const std::vector<Command>& commands();

/// The command that the words begin with ("plugins new" rather than "plugins"); null where there is none.
const Command* find_command(const std::vector<std::string>& words);

/// Whether its name is two words.
bool is_below_another(const Description& command);

/// Second words of the commands that are below this one: conform and new of plugins.
std::vector<std::string> words_below(const Description& command);

/// What the program is, in two lines.
std::string purpose();

struct ExitCode {
  int code;
  std::string brief;    ///< for --help
  std::string meaning;  ///< for the manual and the reference; `literal`
};
std::vector<ExitCode> exit_codes();

/// A name and what it means, `literal` where it names something.
struct Entry {
  std::string name, meaning;
};
std::vector<Entry> environment();
std::vector<Entry> files();  ///< that the program reads and leaves, besides its arguments

/// What --help prints.
std::string overview();

/// The forms of all commands, as --help shows them.
std::string usage_of_all();

}  // namespace hauberk::command
