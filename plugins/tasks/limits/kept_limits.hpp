#pragma once
/// Limits of an interrupted run, to go on from.

#include "limits/limits.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <boost/json/value.hpp>

#include <optional>
#include <vector>

namespace hauberk {

/// By task: what is finished.
struct KeptLimits {
  /// What tables, plots and profiles need of them.
  std::vector<std::optional<LimitResult>> limits;
  /// Their entries in results.json, which stay as they are; null where a limit is not finished.
  std::vector<boost::json::value> entries;
  bool complete = true;
};

/// Finds the finished limits of `tasks` in results of the same experiment. Throws what Boost.JSON throws
/// where these are damaged.
KeptLimits kept_limits(const boost::json::value& results, const Experiment& experiment,
                       const std::vector<LimitTask>& tasks);

}  // namespace hauberk
