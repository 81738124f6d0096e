#pragma once
/// Task stability: families of scenes times methods, each solved, checked and classified.

#include "tasks/task.hpp"

#include <array>

namespace hauberk {

inline constexpr std::array stability_file_names{"stability.csv", "stability.svg"};

std::unique_ptr<TaskRun> prepare_stability(const Prepared& prepared, Diagnostics& diagnostics);

}  // namespace hauberk
