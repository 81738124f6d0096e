#pragma once
/// What came of the checks of a plugin, for people and for programs.

#include <hauberk/conformance/check.hpp>

#include <string>
#include <vector>

namespace hauberk::conformance {

struct Result {
  std::string name, about;
  Outcome outcome;
  double seconds = 0.0;
};

struct Report {
  std::string file;
  std::string id, version, kind;  ///< empty when it could not be loaded
  Setup setup;
  std::uint64_t seed = 1;
  std::vector<Result> results;

  int count(Outcome::Status status) const;
  bool passed() const { return count(Outcome::Status::failed) == 0; }
  /// A line per check, a summary, and for failures the command that repeats each. The same for the same
  /// plugin and seed.
  std::string text() const;
  /// {"format": "hauberk-conformance/1", "plugin": {...}, "seed", "checks": [{name, status, text, seconds}],
  /// ...}
  std::string json() const;
};

}  // namespace hauberk::conformance
