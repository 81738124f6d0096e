#pragma once
/// The parts that read_experiment is made of, one per section of the file. Each reads a checked section,
/// reports mistakes and fills what can be filled; defaults that depend on other sections are written back.

#include <hauberk/experiment/plugin_resolver.hpp>
#include <hauberk/experiment/task_format.hpp>

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
  TaskFormats formats;
  std::shared_ptr<const Optimizer> optimizer = {};
};

/// solver. The experiment's seed must have been read.
ExperimentSolver read_solver(Node& section, std::uint64_t seed);

/// load_case: plugin, directions, senses, into `experiment`, whose scene.length must be set.
void read_load_case(Node& root, PluginResolver& plugins, bool angles_only, Problems& problems,
                    Experiment& experiment);

/// load_case.directions; the load case and the task must have been read. The file's other ways to say what is
/// asked for (directions_deg, senses) are refused beside it.
void read_directions(const Node& section, bool angles_only, Problems& problems, Experiment& experiment);

/// What variants of the file start from; `file` is the whole file before it was checked.
VariantBase variant_base(const Node& file, const Lookups& lookups);

/// Everything from a tree with values in place to an experiment. `well_formed`, when wanted: nothing was
/// wrong with its form (keys, types, ranges).
std::optional<Experiment> read_tree(Node given, const Lookups& lookups, Diagnostics& diagnostics,
                                    bool* well_formed = nullptr);

/// expect.
std::vector<Expectation> read_expectations(const Node& list, Problems& problems);

}  // namespace hauberk
