#pragma once
/// The parts that read_experiment is made of, one per section of the file. Each reads a checked section,
/// reports mistakes and fills what can be filled; defaults that depend on other sections are written back.

#include "plugin_resolver.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Where an experiment finds what it names.
struct Lookups {
  const PluginLookup& plugins;
  WeaveLookup weaves;
  std::string folder;  ///< that paths of plugins' files are relative to; empty: the working directory
  FileObserver files;
};

/// Reports entries of `directions` that repeat an earlier one modulo 180 degrees.
void check_directions(const std::vector<std::pair<const Node*, double>>& directions, Problems& problems);

/// solver. The experiment's seed must have been read.
ExperimentSolver read_solver(Node& section, std::uint64_t seed);

/// load_case: plugin, directions, senses, into `experiment`, whose scene.length must be set.
void read_load_case(Node& root, PluginResolver& plugins, Problems& problems, Experiment& experiment);

/// load_case.directions; the load case and the task must have been read. The file's other ways to say what is
/// asked for (directions_deg, senses) are refused beside it.
void read_directions(const Node& section, Problems& problems, Experiment& experiment);

/// design; needs scene, load case and solver of `experiment`. `tile_of`: see ReadScene. `scene_complete`:
/// nothing was wrong with it.
ExperimentDesign read_design(Node& section, PluginResolver& plugins, Problems& problems,
                             const Experiment& experiment, const std::vector<int>& tile_of,
                             bool scene_complete);

/// design.variables. `tile_of`: see ReadScene.
std::vector<ExperimentVariable> read_variables(const Node& list, const SceneSpec& scene,
                                               const std::vector<int>& tile_of, bool scene_complete,
                                               Problems& problems);

/// What variants of the file start from; `file` is the whole file before it was checked.
VariantBase variant_base(const Node& file, const Lookups& lookups);

/// stability.
ExperimentStability read_stability(const Node& section, VariantBase base, Problems& problems);

/// sweep; names of limits are those of `experiment`, whose directions and senses must have been read.
ExperimentSweep read_sweep(const Node& section, VariantBase base, const Experiment& experiment,
                           Problems& problems);

/// Pointers of the sweep must lead to something in the file as written or as resolved: a slip of the keyboard
/// would otherwise be refused row by row.
void check_sweep_pointers(const Node& section, const ExperimentSweep& sweep, const Node& resolved,
                          Problems& problems);

/// chart.
ExperimentChart read_chart(const Node& section, VariantBase base, Problems& problems);

/// transition; fills in the range. `clearance` is the solver's.
ExperimentTransition read_transition(Node& section, const SceneSpec& scene, double clearance,
                                     bool scene_complete, Problems& problems);

/// Everything from a tree with values in place to an experiment. `well_formed`, when wanted: nothing was
/// wrong with its form (keys, types, ranges).
std::optional<Experiment> read_tree(Node given, const Lookups& lookups, Diagnostics& diagnostics,
                                    bool* well_formed = nullptr);

/// expect.
std::vector<Expectation> read_expectations(const Node& list, Problems& problems);

}  // namespace hauberk
