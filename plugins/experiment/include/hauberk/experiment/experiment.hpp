#pragma once
/// An experiment, read, checked and expanded: everything resolved into plain types and kernel structs.

#include "document/diagnostics.hpp"
#include "limits/limit_result.hpp"
#include "model/scene.hpp"

#include <hauberk/experiment/expect.hpp>
#include <hauberk/plugin.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

struct TaskFormat;
using TaskFormats = std::span<const TaskFormat>;

/// What the section of one task says, as its reader made it.
struct TaskSection {
  TaskSection() = default;
  TaskSection(const TaskSection&) = default;
  TaskSection& operator=(const TaskSection&) = default;
  virtual ~TaskSection() = default;

  /// Directions (degrees) of the task's own limits, for a load case that names none.
  virtual std::vector<double> own_directions() const { return {}; }
};

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
  TaskFormats formats;  ///< as of the file
  WeaveLookup weaves;
  std::string folder;  ///< of the experiment, that its paths are relative to
  FileObserver files;
};

struct Experiment {
  /// The section of that kind; null where the file has none.
  template <class Section>
  const Section* section() const
  {
    for (const std::shared_ptr<const TaskSection>& s : sections) {
      if (const auto* found = dynamic_cast<const Section*>(s.get())) return found;
    }
    return nullptr;
  }

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
  /// What the sections of tasks say, whichever of them is run.
  std::vector<std::shared_ptr<const TaskSection>> sections;
  bool has_variants = false;  ///< a section makes experiments out of the file
  std::vector<Expectation> expect;
  /// Where an override made another experiment of the file, whose `expect` says nothing of it and is emptied.
  std::string expect_of_other;
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
  TaskFormats formats = {};            ///< of the tasks that there are beside limits
  /// Of the caller: what `"optimizer": {"plugin": "caller"}` means. Null: that is refused.
  std::shared_ptr<const Optimizer> optimizer = {};
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

/// Text of a file. Throws InputError "cannot read 'x.json': ..." when it cannot be read or is beyond 64 MB.
std::string read_text_file(const std::string& path);

/// Reads the file at `path`. Throws InputError with all problems, one per line.
Experiment load_experiment(const std::string& path, const std::vector<std::string>& overrides,
                           const PluginLookup& plugins, TaskFormats formats);

/// An experiment that computes the limits of `scene` (an expansion of `experiment`'s scene, e.g. a design's
/// result) with the same load case and solver, without design and expect: one cell and how often it is
/// repeated where cells are alike, else every element placed by itself. Write it with write_json.
Node scene_experiment(const Experiment& experiment, const SceneSpec& scene, const std::string& name);

/// `written`, made of `experiment`, as it has to be in a file of the folder `to`: paths of plugins' files
/// that are relative lead to the same files from there.
Node in_folder(Node written, const Experiment& experiment, const std::string& to);

}  // namespace hauberk
