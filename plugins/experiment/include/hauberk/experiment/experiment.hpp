#pragma once
/// An experiment, read, checked and expanded: everything resolved into plain types and kernel structs.

#include <hauberk/experiment/diagnostics.hpp>
#include <hauberk/experiment/expect.hpp>
#include <hauberk/plugin.hpp>
#include <hauberk/results.hpp>
#include <hauberk/scene.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// Finds a plugin by kind and id; null and a sentence in `error` when there is none. The table must outlive
/// every experiment that was read with it.
using PluginLookup =
    std::function<const PluginTable*(PluginKind kind, const std::string& id, std::string& error)>;

/// Text of the weave file that `name` stands for (a name of the library, or a path as the experiment gives
/// it); null and a sentence in `error` when there is none. Empty function: there is no library.
using WeaveLookup = std::function<std::optional<std::string>(const std::string& name, std::string& error)>;

/// The section `solver`. Absent values are decided by the preset.
struct ExperimentSolver {
  std::string preset;                              ///< "accurate", "paper"
  double clearance = 0.0;                          ///< file units
  std::string contact;                             ///< "auto", or as contact_named
  std::optional<int> facets;                       ///< of contact "mesh"
  std::optional<std::string> closest_points, ccd;  ///< "certified", "sampled"
  std::optional<double> finite_target;
  int starts = 1;
  double perturbation = 0.0;  ///< characteristic lengths and radians
  bool lessons = true;
  double neighbours = 0.0;  ///< degrees
  int tilts = 0;
  double tilt = 0.0;  ///< degrees
  std::uint64_t start_seed = 1;
  std::optional<int> max_stages, max_iterations;
  std::optional<double> tolerance;
};

/// One parameter of one placed element.
struct ParameterRef {
  int element = 0;
  int parameter = 0;  ///< in the order of the element's shape
};

/// One design variable; all its parameters have the same value.
struct ExperimentVariable {
  std::string name;  ///< "3/ring.R" (element 3; of a patch: place 3 of every tile), "link/ring.R" (type),
                     ///< "*/ring.R" (all)
  double initial = 0.0, lower = 0.0, upper = 0.0;
  std::vector<ParameterRef> parameters;
};

struct ExperimentTarget {
  double direction_deg = 0.0, value = 0.0, weight = 1.0;
};

/// The section `design`.
struct ExperimentDesign {
  std::string optimizer_plugin;
  std::shared_ptr<const Optimizer> optimizer;
  std::string quantity;  ///< "eta", "stretch", "compress", "curvature"
  std::vector<ExperimentVariable> variables;
  std::vector<ExperimentTarget> targets;
  bool plain_value = false;                           ///< design.value is "plain"
  double hole_clearance = 0.0, rest_clearance = 0.0;  ///< file units
  int starts = 1;
  double perturbation = 0.0;  ///< fraction of upper - lower
  std::optional<int> max_iterations;
  std::optional<double> tolerance;  ///< relative deviation at which a target counts as reached
};

/// A value put at a place of the file, as --set does.
struct Assignment {
  std::string pointer;
  Node value;
};

/// Is told of every file that a plugin is given: its path as written, and as it is seen from the working
/// directory.
using FileObserver = std::function<void(const std::string& written, const std::string& located)>;

/// A file as given, without what a variant of it does not have (tasks other than limits, expect): variants
/// are made from what is written, not from defaults that follow from it.
struct VariantBase {
  Node file;
  WeaveLookup weaves;
  std::string folder;  ///< of the experiment, that its paths are relative to
  FileObserver files;
};

/// A way of solving: what it sets, usually below /solver.
struct StabilityMethod {
  std::string name;
  std::vector<Assignment> set;
};

/// Variants of one scene, from easy to hard.
struct StabilityFamily {
  std::string name, why;
  std::vector<std::string> labels;               ///< of the members
  std::vector<std::vector<Assignment>> members;  ///< what makes each of them out of the base scene
  std::vector<std::optional<double>> exact;      ///< of the members; null: not known
  bool solvable = true;                          ///< there is a locked state to find
};

/// The section `stability`.
struct ExperimentStability {
  double tolerance = 0.0;  ///< of 1 + value
  std::vector<StabilityMethod> methods;
  std::vector<StabilityFamily> families;
  VariantBase base;
};

/// A place that a swept value goes to, as factor times value plus offset.
struct SweepPlace {
  std::string pointer;
  double factor = 1.0, offset = 0.0;  ///< 1 and 0: any value, else numbers only
};

/// A quantity that is varied: all its places move together.
struct SweepAxis {
  std::string name;
  std::vector<SweepPlace> places;
  std::vector<Node> values;
  bool logarithmic = false;  ///< values are evenly spaced on a logarithmic scale
};

/// What is recorded of every row.
struct SweepMeasure {
  std::string name, pointer;  ///< pointer into the row's results
};

/// The section `sweep`: every combination of the values of its axes is a row.
struct ExperimentSweep {
  std::vector<SweepAxis> axes;
  std::vector<SweepMeasure> measure;  ///< the values of all limits when the file says nothing
  VariantBase base;

  std::size_t row_count() const;
  /// Which value of each axis a row has; the last axis is the fastest.
  std::vector<std::size_t> indices(std::size_t row) const;
};

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
struct ExperimentChart {
  int repeats = 3;
  std::vector<ChartScene> scenes;
  std::vector<ChartMethod> methods;
  std::vector<int> threads;  ///< 0: all processors
  VariantBase base;
};

/// A rigid motion of one element, linear in time: a rotation about a line and then a translation, from rest.
struct TransitionPathInput {
  std::string name;
  Vec3 axis = Vec3::Zero();     ///< unit; zero: no rotation
  Vec3 through = Vec3::Zero();  ///< a point of the line, file units
  double degrees_from = 0.0, degrees_to = 0.0;
  Vec3 shift_from = Vec3::Zero(), shift_to = Vec3::Zero();  ///< file units
  int steps = 200;
};

/// The section `transition`. Lengths in file units.
struct ExperimentTransition {
  int fixed = 0, moving = 1;  ///< placed elements
  double activation_distance = 0.0, range = 0.0;
  std::vector<std::string> contacts;  ///< "nearest", "published", "arc", "auto"
  std::vector<TransitionPathInput> paths;
};

struct Experiment {
  std::string name;
  std::string task = "limits";
  std::string length_unit;  ///< "m", "mm", "um": a label
  std::uint64_t seed = 1;
  SceneSpec scene;     ///< with `repeat` expanded; scene.length is the characteristic length L
  bool relax = false;  ///< cell.relax
  std::string load_case_plugin;
  std::shared_ptr<const LoadCase> load_case;
  std::vector<double> directions_deg;  ///< as given; of the final profile for a design
  std::vector<Sense> senses;           ///< as given; both when absent; none for `directions`
  std::vector<Direction> directions;   ///< along components, instead of directions_deg and senses
  std::vector<Triangle> triangles;     ///< of indices into `directions`, where these sample a sphere
  ExperimentSolver solver;
  std::optional<ExperimentDesign> design;          ///< set whenever the file has the section
  std::optional<ExperimentStability> stability;    ///< likewise
  std::optional<ExperimentTransition> transition;  ///< likewise
  std::optional<ExperimentSweep> sweep;            ///< likewise
  std::optional<ExperimentChart> chart;            ///< likewise
  bool has_variants = false;                       ///< a section makes experiments out of the file
  std::vector<Expectation> expect;
  Node resolved;  ///< the checked file with all defaults filled in; write_json writes it as an experiment
  Node expanded;  ///< the same, but with what a weave brings also where `resolved` keeps it for its variants
  std::string folder;                     ///< of the file; empty: the working directory
  std::vector<std::string> plugin_files;  ///< paths of files that plugins were given, as written
};

/// What to read.
struct ExperimentSource {
  std::string file;                    ///< named in messages; plugins' files are relative to its folder
  std::string text;                    ///< JSON with comments and trailing commas
  std::vector<std::string> overrides;  ///< --set assignments, applied in order
  WeaveLookup weaves = {};             ///< for cell.weave
  FileObserver files = {};             ///< of plugins; may be none
};

/// Reads, checks and expands an experiment. Every problem is put into `diagnostics`; null when there is any.
/// Thread safe as far as the lookup is.
std::optional<Experiment> read_experiment(const ExperimentSource& source, const PluginLookup& lookup,
                                          Diagnostics& diagnostics);

/// A variant of a file as an experiment of its own.
struct VariantReading {
  std::optional<Experiment> experiment;  ///< null: it makes no sense, and `refusal` says why
  std::string refusal;
};

/// Makes an ordinary experiment (task limits) named `name` by putting `values` into `base` and reads it. A
/// mistake in the form of the file (an unknown key, a value of the wrong type, a pointer that leads nowhere)
/// goes to `diagnostics`, its message after `place`; values that make no scene are no mistake but an answer:
/// that input is refused.
VariantReading read_variant(const VariantBase& base, const std::vector<Assignment>& values,
                            const std::string& name, const std::string& place, const PluginLookup& lookup,
                            Diagnostics& diagnostics);

/// One member of a family, by one method.
VariantReading read_stability_member(const ExperimentStability& stability, std::size_t family,
                                     std::size_t member, std::size_t method, const PluginLookup& lookup,
                                     Diagnostics& diagnostics);

/// One row of a sweep; `name` is the experiment's.
VariantReading read_sweep_row(const ExperimentSweep& sweep, std::size_t row, const std::string& name,
                              const PluginLookup& lookup, Diagnostics& diagnostics);

/// A scene of a chart, with the settings of its reference where it has one.
VariantReading read_chart_scene(const ExperimentChart& chart, std::size_t scene, const PluginLookup& lookup,
                                Diagnostics& diagnostics);

/// A scene of a chart by one method in one setting.
VariantReading read_chart_setting(const ExperimentChart& chart, std::size_t scene, std::size_t method,
                                  std::size_t setting, const PluginLookup& lookup, Diagnostics& diagnostics);

/// Text of a file. Throws InputError "cannot read 'x.json': ..." when it cannot be read or is beyond 64 MB.
std::string read_text_file(const std::string& path);

/// Reads the file at `path`. Throws InputError with all problems, one per line.
Experiment load_experiment(const std::string& path, const std::vector<std::string>& overrides,
                           const PluginLookup& plugins);

/// An experiment that computes the limits of `scene` (an expansion of `experiment`'s scene, e.g. a design's
/// result) with the same load case and solver: every element placed by itself, without design and expect.
/// Write it with write_json.
Node scene_experiment(const Experiment& experiment, const SceneSpec& scene, const std::string& name);

/// `written`, made of `experiment`, as it has to be in a file of the folder `to`: paths of plugins' files
/// that are relative lead to the same files from there.
Node in_folder(Node written, const Experiment& experiment, const std::string& to);

}  // namespace hauberk
