#pragma once
/// Task transition: energy and force of contact formulations along motions through a merge of minima.

#include "tasks/task.hpp"

#include <array>

namespace hauberk {

inline constexpr std::array transition_file_names{"transition.csv", "minima.csv", "transition.svg"};

std::unique_ptr<TaskRun> prepare_transition(const Prepared& prepared, Diagnostics& diagnostics);

}  // namespace hauberk
