#pragma once
/// What every plugin must do, as plain functions: run by `hauberk plugins conform`, and by the tests of
/// authors (hauberk/conformance/gtest.hpp).

#include <hauberk/plugin.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::conformance {

/// How a plugin is set up for the checks.
struct Setup {
  /// Its section of an experiment as JSON; common keys such as "shape" or "directions_deg" are passed over,
  /// and the `parameters` of a shape are the point around which it is looked at. Empty: made from its fields,
  /// of defaults and, where something is required, of the simplest value.
  std::string section;
  /// Whether checks of a kind are run again with every boolean, every choice and every kind of value in it
  /// set otherwise, one at a time.
  bool switches = true;
};

/// What came of a check.
struct Outcome {
  /// Slow: it, or what it called, took longer than it may, and nothing is known to be wrong with the answers.
  enum class Status { passed, failed, skipped, slow };
  Status status = Status::passed;
  std::string text;  ///< failed, slow: what is wrong with which numbers; skipped: why; passed: nothing
  std::vector<std::pair<std::string, double>> times = {};  ///< seconds of a call, where they were measured
};

/// "passed", "failed", "skipped", "slow".
const char* status_name(Outcome::Status status);

/// One property of a plugin. Its function is deterministic: the seed decides what is drawn.
struct Check {
  std::string name;                ///< "shape.jacobians"
  std::optional<PluginKind> kind;  ///< null: of every kind
  std::string about;               ///< what must hold, a sentence
  std::function<Outcome(const PluginTable& table, const Setup& setup, std::uint64_t seed)> run;
};

/// The checks of a kind, those of every kind first. Thread safe.
std::vector<Check> checks(PluginKind kind);

/// Those whose name matches the regular expression (ECMAScript, anywhere in the name). Throws InputError when
/// it is none, or when nothing matches.
std::vector<Check> matching(const std::vector<Check>& all, const std::string& filter);

/// Runs a check in this process; whatever the plugin throws is a failure that says so. A crash or an endless
/// loop is not survived: see isolated.hpp.
Outcome run(const Check& check, const PluginTable& table, const Setup& setup, std::uint64_t seed);

}  // namespace hauberk::conformance
