#pragma once
/// Task design: initial limits, the search, and the limits of what it found.

#include "results/designed_experiment.hpp"
#include "tasks/task.hpp"

#include <array>

namespace hauberk {

inline constexpr std::array design_file_names{designed_file, designed_fabric_file, best_so_far_file};

/// An interrupted search is repeated from the evaluations in the output folder (evaluation_log.hpp): what
/// comes out is the same as of one run.
std::unique_ptr<TaskRun> prepare_design(const Prepared& prepared, Diagnostics& diagnostics);

}  // namespace hauberk
