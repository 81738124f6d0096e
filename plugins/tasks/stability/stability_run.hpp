#pragma once
/// Families of scenes times methods, each solved, checked and classified.

#include "run/progress.hpp"
#include "tasks/stability/stability_loading.hpp"

#include "tasks/stability/stability_results.hpp"

#include <functional>
#include <vector>

namespace hauberk {

/// All cases, not computed yet, in the order of the results.
StabilityMap empty_map(const ExperimentStability& stability, const std::vector<StabilityItem>& items);

/// All cases so far; those not done have outcome interrupted.
using MapObserver = std::function<void(const StabilityMap&)>;

/// Computes every case that is interrupted in `map`, a member and method being an item for the threads, until
/// done or interrupted, and classifies all. Results do not depend on `threads`. `observer` is called after
/// every item, one call at a time. What one item throws is its result and does not stop the others.
void run_stability(const std::vector<StabilityItem>& items, unsigned threads, Progress& progress,
                   StabilityMap& map, const MapObserver& observer);

}  // namespace hauberk
