#pragma once
/// Task design: initial limits, the search, and the limits of what it found.

#include "loading.hpp"
#include "output.hpp"
#include "progress.hpp"

namespace hauberk::command {

/// Runs the whole task into `run`, writing partial results on the way. With `go_on` an interrupted search of
/// the same experiment is repeated from the evaluations in the output folder: what comes out is the same as
/// of one run. Stops early when interrupted; what there is then is in `run`.
void run_design_task(const Loaded& loaded, unsigned threads, bool go_on, Progress& progress, Output& output,
                     RunResult& run);

}  // namespace hauberk::command
