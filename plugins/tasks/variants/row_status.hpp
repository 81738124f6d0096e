#pragma once
/// How the computation of one variant of a file ended: a row of a sweep, a point of a chart.

#include "limits/limit_result.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

enum class RowStatus {
  done,        ///< every limit has an answer
  failed,      ///< a limit stalled or failed, or the computation stopped
  refused,     ///< bad input: there is no such scene
  interrupted  ///< not computed
};
inline constexpr std::array row_statuses{RowStatus::done, RowStatus::failed, RowStatus::refused,
                                         RowStatus::interrupted};
/// "done", "failed", "refused", "interrupted".
std::string to_string(RowStatus status);

/// The status of that name; none where there is none. Thread safe.
std::optional<RowStatus> row_status(const std::string& name);

/// What limits amount to together, and a message that names those that stalled or failed. Thread safe.
std::pair<RowStatus, std::string> status_of(const std::vector<LimitResult>& limits);

}  // namespace hauberk
