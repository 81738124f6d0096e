#pragma once
/// Checks in processes of their own: a plugin that crashes or never returns fails a check, not the program.

#include <hauberk/conformance/report.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hauberk::conformance {

/// Where and how checks run.
struct Conditions {
  std::uint64_t seed = 1;
  int seeds = 1;               ///< each check is run with so many seeds, one after the other, until it fails
  double seconds = 60.0;       ///< longest processor time of a run of a check; not kept in this process
  bool until_failure = false;  ///< no further checks are run after one that did not pass
  bool in_process = false;     ///< for debuggers
  std::string filter;          ///< of names; empty: all
  std::string plugin;          ///< id of one of the plugins of a library; empty: the only one
  Setup setup;
  /// Told before each check of a plugin: its name, how many are done, and of how many.
  std::function<void(const std::string& check, std::size_t done, std::size_t total)> on_check;
};

/// Loads the plugin and runs its checks. A plugin that cannot be loaded, and one that is not named where the
/// library has several, is a report of one failed check, `load`. Throws InputError for a bad filter.
Report conform(const std::filesystem::path& file, const Conditions& conditions);

/// The same of every plugin of the library, in its order, or of the one that the conditions name. Of several,
/// those without a check that the filter matches are left out; InputError where there is none in any.
std::vector<Report> conform_all(const std::filesystem::path& file, const Conditions& conditions);

}  // namespace hauberk::conformance
