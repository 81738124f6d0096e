#pragma once
/// The tasks that there are.

#include "tasks/task.hpp"

#include <hauberk/experiment/task_format.hpp>

#include <span>
#include <string_view>
#include <vector>

namespace hauberk {

/// Every task, in the order in which documents name them.
std::span<const Task> all_tasks();

/// Their sections of experiments.
TaskFormats task_formats();

/// The task of that name; there must be one.
const Task& task_named(std::string_view name);

/// Names of all files that a run may leave in its folder, results.json first.
std::vector<const char*> result_names();

}  // namespace hauberk
