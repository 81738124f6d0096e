#pragma once
/// Task sweep: limits of the experiment with other values in it, row by row.

#include "tasks/task.hpp"

#include <array>

namespace hauberk {

inline constexpr std::array sweep_file_names{"sweep.csv", "sweep.svg"};

std::unique_ptr<TaskRun> prepare_sweep(const Prepared& prepared, Diagnostics& diagnostics);

}  // namespace hauberk
