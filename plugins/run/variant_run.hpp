#pragma once
/// One variant of a file (a member of a stability family, a row of a sweep, a point of a chart) from its
/// experiment to its results.

#include "design/run_result.hpp"
#include "limits/limit_result.hpp"
#include "limits/limits.hpp"
#include "run/scene_at_rest.hpp"

#include <hauberk/experiment/experiment.hpp>

namespace hauberk {

/// Everything that comes before the solve.
struct PreparedVariant : SceneAtRest {
  std::vector<LimitTask> tasks;
};

/// The rest state of an ordinary limits experiment, with all checks that `check` makes of it. Throws
/// InputError where there is no such scene.
PreparedVariant prepare_variant(const Experiment& experiment);

struct VariantLimits {
  std::vector<LimitResult> limits;           ///< those that a signal stopped have status interrupted
  std::vector<LimitResult> unreported;       ///< solved for their states alone
  std::vector<std::optional<State>> states;  ///< furthest locked state, by task
};

/// The solve. Its result depends on the variant alone, whatever `threads` (0: all processors). `memory`: as
/// LimitsObserver::memory.
VariantLimits solve_variant(const PreparedVariant& prepared, unsigned threads,
                            SearchMemory* memory = nullptr);

/// What follows from limits.
RunResult variant_result(const Experiment& experiment, PreparedVariant prepared, VariantLimits solved);

/// All of it. Uses one thread: variants are what is done in parallel. Throws InputError where there is no
/// such scene.
RunResult run_variant(const Experiment& experiment, SearchMemory* memory = nullptr);

}  // namespace hauberk
