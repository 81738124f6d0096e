#pragma once
/// The scenes that a chart solves.

#include "run/prepared.hpp"

namespace hauberk {

/// A scene of a chart by one method in one setting.
struct ChartItem {
  std::size_t scene = 0, method = 0, setting = 0;
  VariantReading reading;
};

struct LoadedChart {
  std::vector<VariantReading> scenes;  ///< with the settings of their references; none is refused
  std::vector<ChartItem> items;        ///< by scene, method, setting
};

/// The scenes of the chart of `e`, and each by every method that solves it in every setting. What is wrong
/// with the form of one, a scene that is refused as input, limits that are not those of the scene, and exact
/// values that are not as many as limits are reported in `diagnostics`; points that are refused as input are
/// items without an experiment.
LoadedChart load_chart(const Experiment& e, const PluginLookup& lookup, Diagnostics& diagnostics);

}  // namespace hauberk
