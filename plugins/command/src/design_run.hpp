#pragma once
/// Task design: initial limits, the search, and the limits of what it found.

#include "loading.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "resume.hpp"

namespace hauberk::command {

/// Runs the whole task into `run`, writing partial results on the way. `start` is null unless a design is
/// resumed. Stops early when interrupted; what there is then is in `run`.
void run_design_task(const Loaded& loaded, unsigned threads, const std::optional<ResumedDesign>& start,
                     Progress& progress, Output& output, RunResult& run);

}  // namespace hauberk::command
