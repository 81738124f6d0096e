#pragma once
/// Files of limits beside results.json.

#include "design/run_result.hpp"
#include "tasks/task.hpp"

#include <array>

namespace hauberk {

inline constexpr std::array limit_file_names{"limits.csv", "profile.svg", "boundary.ply", "boundary.svg"};

/// limits.csv and profile.svg; of limits along components limits.csv and, of three unknowns, the boundary as
/// a surface and a picture.
std::vector<ResultFile> limit_files(const Prepared& prepared, const RunResult& run);

}  // namespace hauberk
