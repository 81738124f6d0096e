#pragma once
#include "loading.hpp"

namespace hauberk::command {

/// Every row of the sweep of `e`. What is wrong with the form of a row is reported in `diagnostics`; rows
/// that are refused as input are readings without an experiment.
std::vector<VariantReading> load_sweep(const Experiment& e, const PluginLookup& lookup,
                                       Diagnostics& diagnostics);

}  // namespace hauberk::command
