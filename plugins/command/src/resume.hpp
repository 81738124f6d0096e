#pragma once
/// What an interrupted run left, to go on from.

#include "loading.hpp"

#include <hauberk/results/chart.hpp>
#include <hauberk/results/stability.hpp>
#include <hauberk/results/sweep.hpp>

#include <boost/json/value.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace hauberk::command {

struct Resumed {
  /// Finished limits by task, and their entries of results.json (null where not finished).
  std::vector<std::optional<LimitResult>> limits;
  std::vector<boost::json::value> entries;
  std::optional<StabilityMap> stability;  ///< with the finished cases; task stability only
  std::optional<SweepTable> sweep;        ///< with the finished rows; task sweep only
  std::optional<PrecisionChart> chart;    ///< with the finished runs; task chart only
  std::optional<double> load_average;     ///< before the runs so far; task chart only
  std::int64_t peak_memory_bytes = 0;     ///< of the runs so far
  bool complete = false;                  ///< nothing is left to be done
  boost::json::value document;            ///< of a complete run
};

/// Reads `directory`/results.json; nothing when it is not there. Throws InputError when it cannot be read, or
/// was computed from another experiment or by another version of the program: results of both in one file
/// would not say where they come from.
std::optional<Resumed> read_resumed(const std::filesystem::path& directory, const Loaded& loaded);

}  // namespace hauberk::command
