#pragma once
/// Task limits: the limits that the load case names.

#include "tasks/task.hpp"

namespace hauberk {

std::unique_ptr<TaskRun> prepare_limits(const Prepared& prepared, Diagnostics& diagnostics);

}  // namespace hauberk
