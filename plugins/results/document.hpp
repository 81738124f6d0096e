#pragma once
/// The document of results.json, format "hauberk-results/2"; share/doc/results.md explains every field.

#include "design/run_result.hpp"

#include <boost/json/object.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

inline constexpr const char* results_format = "hauberk-results/2";
/// Its name in a folder of results.
inline constexpr const char* results_file = "results.json";
/// The page that a run leaves beside it where it is asked for one, and a report of many.
inline constexpr const char* page_file = "report.html";

/// What times depend on.
struct Machine {
  std::string processor;  ///< model name; empty where the system does not tell
  int processors = 0;
  std::optional<double> load_average;  ///< of the last minute, before the run; null where not told
};

/// Where a result comes from. Everything but `threads`, `peak_memory_bytes` and the machine's load must be
/// the same for repeated runs of one build on one machine, so there is no date, host or path in it.
struct Provenance {
  struct Plugin {
    std::string id, kind, version;
    std::string file, sha256;  ///< name of the library, without its folder, and digest of its content
  };
  std::string version;     ///< of Hauberk
  std::string build_type;  ///< build type and instrumentation
  std::string compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
  std::vector<Plugin> plugins;
  /// Name and text of weave files that the experiment refers to without saying what they hold.
  std::vector<std::pair<std::string, std::string>> weaves;
  std::uint64_t seed = 0;
  int threads = 1;
  std::int64_t peak_memory_bytes = 0;   ///< largest resident size, of all runs that went on from each other
  std::optional<Machine> machine = {};  ///< where times are the result
  /// Path as written in the experiment and fingerprint of files that plugins have read.
  std::vector<std::pair<std::string, std::string>> files = {};
  /// Of a run whose parts were computed on processors of several kinds: their names.
  std::vector<std::string> processors = {};
};

/// As in the document. Thread safe.
boost::json::object provenance_json(const Provenance& provenance);

/// The document of a run that has no results yet: without limits, and without `files`, which is its last key.
/// `experiment_json` is the resolved experiment as strict JSON text. Throws InputError when that is
/// malformed, and what shapes throw. Thread safe.
boost::json::object document_without_results(const std::string& experiment_json, const Provenance& provenance,
                                             boost::json::value plan, const SceneSpec& scene);

/// Enters scene, limits, profiles, design and boundary. `macro_names`: of the macroscopic unknowns, for
/// `starts` of limits whose own `macro` is empty. Thread safe.
void enter_run(boost::json::object& document, const RunResult& run,
               const std::vector<std::string>& macro_names);

/// The document of limits by themselves, without provenance, plan and files. Lengths are in the experiment's
/// unit. Quaternions are [w, x, y, z], unit, w >= 0; absent optionals and numbers that are not finite
/// are null. Keys have a fixed order. Throws InputError when a JSON text is malformed, and what shapes throw.
/// Thread safe.
boost::json::object results_document(const RunResult& run, const std::string& experiment_json,
                                     const std::vector<std::string>& macro_names);

/// The status of that name, as `to_string` gives it; none where there is none. Thread safe.
std::optional<LimitStatus> limit_status(const std::string& name);

}  // namespace hauberk
