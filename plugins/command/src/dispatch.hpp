#pragma once
/// From the words of a command line to an exit code.

#include "description.hpp"

#include <string>
#include <vector>

namespace hauberk::command {

/// Exit codes of the program.
inline constexpr int exit_done = 0;           ///< done
inline constexpr int exit_failed = 1;         ///< the computation failed; what was computed is on disk
inline constexpr int exit_bad_input = 2;      ///< bad input; nothing was written
inline constexpr int exit_interrupted = 130;  ///< interrupted; partial results are on disk

/// Runs the command that `words` (without the program's name) ask for and returns the exit code. Writes
/// to stdout and stderr. Never throws.
int dispatch(const std::vector<std::string>& words) noexcept;

// The commands: what they are called and take, and what they do. `words` are what follows their name. They
// throw InputError for bad input. commands.hpp has the table of them.
Description run_description();
int run_command(const std::vector<std::string>& words);

Description gather_description();
int gather_command(const std::vector<std::string>& words);

Description submit_description();
int submit_command(const std::vector<std::string>& words);

Description check_description();
int check_command(const std::vector<std::string>& words);

Description plan_description();
int plan_command(const std::vector<std::string>& words);

Description room_description();
int room_command(const std::vector<std::string>& words);

Description verify_description();
int verify_command(const std::vector<std::string>& words);

Description report_description();
int report_command(const std::vector<std::string>& words);

Description inspect_description();
int inspect_command(const std::vector<std::string>& words);
Description export_description();
int export_command(const std::vector<std::string>& words);

/// A maker's answers. Throws ComputationError where the rings are too small for their wire.
Description weave_description();
int weave_command(const std::vector<std::string>& words);

Description plugins_description();  ///< plugins, plugins list, plugins describe
int plugins_command(const std::vector<std::string>& words);

Description conform_description();  ///< plugins conform
int conform_command(const std::vector<std::string>& words);

/// plugins new: writes a project of a plugin from the installed template, all of its files or none. Throws
/// InputError for a name that is none, and where a file exists already.
Description new_description();
int new_command(const std::vector<std::string>& words);

Description completion_description();
int completion_command(const std::vector<std::string>& words);

Description man_description();
int man_command(const std::vector<std::string>& words);

}  // namespace hauberk::command
