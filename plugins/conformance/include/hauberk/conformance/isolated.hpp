#pragma once
/// Checks in processes of their own: a plugin that crashes or never returns fails a check, not the program.

#include <hauberk/conformance/report.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace hauberk::conformance {

/// What became of a function that ran in a child process.
struct Child {
  bool returned = false;
  std::string text;    ///< what the function returned
  std::string ending;  ///< how the child ended otherwise: "ended by signal 11 (Segmentation fault)", ...
};

/// Runs `f` in a child of this process, which must have no threads that `f` needs. What the child prints is
/// kept from this program's output; its last line is part of `ending`. After `seconds` the child is ended,
/// with all that it started. Throws ComputationError when no process can be made.
Child in_child(const std::function<std::string()>& f, double seconds);

/// Where and how checks run.
struct Conditions {
  std::uint64_t seed = 1;
  double seconds = 60.0;    ///< longest time of a check; not kept in this process
  bool in_process = false;  ///< for debuggers
  std::string filter;       ///< of names; empty: all
  Setup setup;
};

/// Loads the plugin and runs its checks. A plugin that cannot be loaded is a report of one failed check,
/// `load`. Throws InputError for a bad filter.
Report conform(const std::filesystem::path& file, const Conditions& conditions);

}  // namespace hauberk::conformance
