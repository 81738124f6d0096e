#pragma once
/// What every plugin must do, as plain functions: run by `hauberk plugins conform`, and by the tests of
/// authors (hauberk/conformance/gtest.hpp).

#include <hauberk/plugin.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::conformance {

/// How a plugin is set up for the checks.
struct Setup {
  /// Its section of an experiment as JSON; common keys such as "shape" or "directions_deg" are passed over,
  /// and the `parameters` of a shape are the point around which it is looked at. Empty: made from its fields,
  /// of defaults and, where something is required, of the simplest value.
  std::string section;
};

/// What came of a check.
struct Outcome {
  enum class Status { passed, failed, skipped };
  Status status = Status::passed;
  std::string text;  ///< failed: what is wrong with which numbers; skipped: why; passed: a remark, or nothing
};

/// "passed", "failed", "skipped".
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
