#pragma once
/// One variant of a file (a member of a stability family, a row of a sweep) from its experiment to its
/// results.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/results.hpp>

namespace hauberk::command {

/// Limits and profiles of an ordinary limits experiment, from its rest state, with all checks that `check`
/// makes of it. Uses one thread: variants are what is done in parallel, and a variant alone decides its
/// result. Limits that a signal stopped have status interrupted. Throws InputError where there is no such
/// scene.
RunResult run_variant(const Experiment& experiment);

}  // namespace hauberk::command
