#pragma once
/// Limits of an experiment that a maker's answers rest on.

#include "limits/limit_result.hpp"
#include "run/progress.hpp"
#include "tasks/job.hpp"

#include <string>
#include <vector>

namespace hauberk::maker {

/// All limits of the job, under the progress display `label`. Throws ComputationError where it is
/// interrupted.
std::vector<LimitResult> limits_of(const Job& job, unsigned threads, const std::string& label,
                                   Progress& progress);

}  // namespace hauberk::maker
