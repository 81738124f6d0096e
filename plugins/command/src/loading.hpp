#pragma once
/// From a file to everything that a computation needs, with every problem of the file reported at once.

#include "options.hpp"

#include <hauberk/design/design.hpp>
#include <hauberk/experiment/experiment.hpp>
#include <hauberk/host/registry.hpp>
#include <hauberk/plan/plan.hpp>
#include <hauberk/results/document.hpp>
#include <hauberk/transition/run.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::command {

/// One member of a family by one method.
struct StabilityItem {
  std::size_t family = 0, member = 0, method = 0;
  std::optional<Experiment> experiment;  ///< null: refused
  std::string refusal;
  std::size_t scene = 0;  ///< equal numbers: the same scene and load, whatever the solver's settings
};

/// A scene of a chart by one method in one setting.
struct ChartItem {
  std::size_t scene = 0, method = 0, setting = 0;
  std::optional<Experiment> experiment;  ///< null: refused
  std::string refusal;
};

struct LoadedChart {
  std::vector<std::optional<Experiment>> scenes;  ///< with the settings of their references; none is null
  std::vector<ChartItem> items;                   ///< by scene, method, setting
};

/// A transition with the model that it refers to.
struct TransitionJob {
  std::shared_ptr<const Model> model;
  TransitionSpec spec;
};

/// An experiment that passed every check.
struct Loaded {
  std::shared_ptr<const Registry> registry;
  std::vector<Provenance::Plugin> plugins;  ///< used, in the order of first use
  /// Name and text, by name, of the weaves that rows and members are made of; empty for other tasks, whose
  /// experiment holds what the weave stands for.
  std::vector<std::pair<std::string, std::string>> weaves;
  /// Path as written and fingerprint of files that plugins have read.
  std::vector<std::pair<std::string, std::string>> files;
  Experiment experiment;
  SceneSpec scene;             ///< rest as used: relaxed where elements touched
  double moved = 0.0;          ///< farthest that relaxation moved an element, file units
  std::optional<State> start;  ///< where limits start, if not at rest (PreparedScene)
  LimitSettings settings;
  std::vector<LimitTask> tasks;             ///< those of the results; of a design: targets first
  std::optional<DesignSpec> design;         ///< task design only
  SceneSpec design_scene;                   ///< rest with the design's clearance; task design only
  std::vector<StabilityItem> stability;     ///< by family, member, method; task stability only
  std::vector<VariantReading> sweep;        ///< by row; task sweep only
  std::optional<LoadedChart> chart;         ///< task chart only
  std::optional<TransitionJob> transition;  ///< task transition only
  Plan plan;
};

/// Reads and checks the experiment that `options` name, up to a rest state that can be loaded. Throws
/// ReportedProblems with a line per problem, InputError when the file cannot be read.
Loaded load(const Options& options);

/// The same for a text with plugins of a registry: reads no file of its own.
Loaded load(std::shared_ptr<const Registry> registry, const ExperimentSource& source);

/// The registry for --plugin-path, HAUBERK_PLUGIN_PATH and this program's place.
std::shared_ptr<const Registry> open_registry(const Options& options);

/// Relaxed rest state of a scene by the model's state in it.
SceneSpec with_rest(const SceneSpec& spec, const Model& model, const State& rest);

}  // namespace hauberk::command
