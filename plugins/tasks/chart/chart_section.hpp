#pragma once
/// The section `chart` of an experiment.

#include <hauberk/experiment/task_format.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// A scene whose limits are known: exactly, or from a solve of higher accuracy.
struct ChartScene {
  std::string name;
  std::vector<Assignment> set;                       ///< what makes it out of the base scene
  std::vector<std::optional<double>> exact;          ///< by limit, null: not compared; empty: see reference
  std::optional<std::vector<Assignment>> reference;  ///< settings of that solve, after `set`
};

/// A way of solving in several settings, for instance from coarse to fine.
struct ChartMethod {
  std::string name;
  std::vector<std::string> labels;                ///< of the settings; "" for one that needs no name
  std::vector<std::vector<Assignment>> settings;  ///< what each of them sets
  std::vector<std::size_t> scenes;                ///< that it solves, ascending
};

/// The section `chart`: error against time of every scene by every method in every setting.
struct ExperimentChart : TaskSection {
  int repeats = 3;
  std::vector<ChartScene> scenes;
  std::vector<ChartMethod> methods;
  std::vector<int> threads;  ///< 0: all processors
  VariantBase base;
};

/// A scene of a chart, with the settings of its reference where it has one.
VariantReading read_chart_scene(const ExperimentChart& chart, std::size_t scene, const PluginLookup& lookup,
                                Diagnostics& diagnostics);

/// A scene of a chart by one method in one setting.
VariantReading read_chart_setting(const ExperimentChart& chart, std::size_t scene, std::size_t method,
                                  std::size_t setting, const PluginLookup& lookup, Diagnostics& diagnostics);

/// Its fields.
Field chart_field();

/// Reads it.
std::shared_ptr<const TaskSection> read_chart(Node& section, SectionContext& context);

}  // namespace hauberk
