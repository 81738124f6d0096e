#pragma once
/// Families of scenes times methods, each solved, checked and classified.

#include "run/context.hpp"
#include "tasks/stability/stability_loading.hpp"
#include "tasks/stability/stability_results.hpp"

#include <vector>

namespace hauberk {

/// All cases, not computed yet, in the order of the results.
StabilityMap empty_map(const ExperimentStability& stability, const std::vector<StabilityItem>& items);

/// Computes every case that is interrupted in `map`, a member and method being an item for the threads, until
/// done or interrupted, and classifies all. Results do not depend on the number of threads. What one item
/// throws is its result and does not stop the others.
void run_stability(const std::vector<StabilityItem>& items, RunContext& context, StabilityMap& map);

}  // namespace hauberk
