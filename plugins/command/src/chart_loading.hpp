#pragma once
#include "loading.hpp"

namespace hauberk::command {

/// The scenes of the chart of `e`, and each by every method that solves it in every setting. What is wrong
/// with the form of one, a scene that is refused as input, limits that are not those of the scene, and exact
/// values that are not as many as limits are reported in `diagnostics`; points that are refused as input are
/// items without an experiment.
LoadedChart load_chart(const Experiment& e, const PluginLookup& lookup, Diagnostics& diagnostics);

}  // namespace hauberk::command
