#pragma once
/// What came of the checks of a plugin, for people and for programs.

#include <hauberk/conformance/check.hpp>

#include <string>
#include <vector>

namespace hauberk::conformance {

struct Result {
  std::string name, about;
  Outcome outcome;
  std::uint64_t seed = 1;  ///< the last one that it was run with
  double seconds = 0.0;    ///< elapsed, of all its runs
};

struct Report {
  std::string file;
  std::string id, version, kind;  ///< empty when it could not be loaded
  bool one_of_several = false;    ///< of its library
  Setup setup;
  std::uint64_t seed = 1;
  int seeds = 1;
  std::vector<Result> results;

  int count(Outcome::Status status) const;
  bool passed() const { return count(Outcome::Status::failed) + count(Outcome::Status::slow) == 0; }
  /// A line per check, a summary, and for what did not pass the command that repeats it: once for each cause,
  /// with the other checks that say the same but for numbers. The same for the same plugin and seed, but for
  /// the last line, which tells the times of calls.
  std::string text() const;
  /// {"format": "hauberk-conformance/1", "plugin": {...}, "seed", "checks": [{name, status, text, seconds}],
  /// ...}
  std::string json() const;
};

}  // namespace hauberk::conformance
