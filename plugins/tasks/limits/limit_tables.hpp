#pragma once
/// Limits on the terminal.

#include "design/run_result.hpp"
#include "limits/limit_result.hpp"
#include "run/prepared.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// What became of the rest state, followed by an empty line; empty where it is as given.
std::string rest_remark(const Prepared& prepared);

/// Tables of limits, and remarks on what is not an answer; several lines.
std::string limit_tables(const Experiment& experiment, const RunResult& run);

/// True when none of them stalled, failed or was interrupted.
bool all_answered(const std::vector<LimitResult>& limits);

}  // namespace hauberk
