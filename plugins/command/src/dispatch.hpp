#pragma once
/// From the words of a command line to an exit code.

#include <string>
#include <vector>

namespace hauberk::command {

/// Exit codes of the program.
inline constexpr int exit_done = 0;           ///< done
inline constexpr int exit_failed = 1;         ///< the computation failed; what was computed is on disk
inline constexpr int exit_bad_input = 2;      ///< bad input; nothing was written
inline constexpr int exit_interrupted = 130;  ///< interrupted; partial results are on disk

/// Runs the sub-command that `words` (without the program's name) ask for and returns the exit code. Writes
/// to stdout and stderr. Never throws.
int dispatch(const std::vector<std::string>& words) noexcept;

// The sub-commands; `words` are what follows their name. They throw InputError for bad input.
int run_command(const std::vector<std::string>& words);
int check_command(const std::vector<std::string>& words);
int plan_command(const std::vector<std::string>& words);
int room_command(const std::vector<std::string>& words);
int verify_command(const std::vector<std::string>& words);
int report_command(const std::vector<std::string>& words);
int plugins_command(const std::vector<std::string>& words);
int conform_command(const std::vector<std::string>& words);  ///< plugins conform

}  // namespace hauberk::command
