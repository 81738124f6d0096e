#pragma once
/// Task limits: the limits that the load case names.

#include "tasks/task.hpp"

namespace hauberk {

std::unique_ptr<TaskRun> prepare_limits(const Prepared& prepared, Diagnostics& diagnostics);

/// A run of this task that is done: `limits` are what was asked for, in its order.
std::unique_ptr<TaskRun> solved_limits(const Prepared& prepared, std::vector<LimitResult> limits);

}  // namespace hauberk
