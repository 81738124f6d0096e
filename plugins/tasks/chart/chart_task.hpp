#pragma once
/// Task chart: error against time of scenes by methods in several settings.

#include "tasks/task.hpp"

#include <array>

namespace hauberk {

inline constexpr std::array chart_file_names{"chart.csv", "chart.svg", "chart_work.svg"};

std::unique_ptr<TaskRun> prepare_chart(const Prepared& prepared, Diagnostics& diagnostics);

}  // namespace hauberk
