#pragma once
#include "loading.hpp"

namespace hauberk::command {

/// Every member of every family by every method. What is wrong with the form of a member is reported in
/// `diagnostics`; members that are refused as input are items without an experiment.
std::vector<StabilityItem> load_stability(const ExperimentStability& stability, const PluginLookup& lookup,
                                          Diagnostics& diagnostics);

}  // namespace hauberk::command
