#include "tasks/variants/row_status.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {

std::string to_string(RowStatus status)
{
  switch (status) {
    case RowStatus::done:
      return "done";
    case RowStatus::failed:
      return "failed";
    case RowStatus::refused:
      return "refused";
    case RowStatus::interrupted:
      return "interrupted";
  }
  return "interrupted";
}

std::optional<RowStatus> row_status(const std::string& name)
{
  const auto* const at = std::find_if(row_statuses.begin(), row_statuses.end(),
                                      [&name](RowStatus status) { return to_string(status) == name; });
  return at == row_statuses.end() ? std::nullopt : std::optional(*at);
}

std::pair<RowStatus, std::string> status_of(const std::vector<LimitResult>& limits)
{
  std::pair<RowStatus, std::string> out{RowStatus::done, ""};
  for (const LimitResult& limit : limits) {
    if (limit.status == LimitStatus::interrupted) return {RowStatus::interrupted, ""};
    if (limit.status != LimitStatus::stalled && limit.status != LimitStatus::failed) continue;
    out.first = RowStatus::failed;
    if (!out.second.empty()) out.second += "; ";
    out.second += fmt::format("{} {}: {}", limit_name(limit.sense, limit.direction), to_string(limit.status),
                              limit.message);
  }
  return out;
}

}  // namespace hauberk
