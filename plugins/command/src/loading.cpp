#include "loading.hpp"
#include "chart_loading.hpp"
#include "nearest_node.hpp"
#include "presets.hpp"
#include "stability_loading.hpp"
#include "sweep_loading.hpp"
#include "tasks.hpp"
#include "transition_run.hpp"
#include "weave_library.hpp"

#include <hauberk/design/design_problem.hpp>
#include <hauberk/host/search_path.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

namespace hauberk::command {
namespace {

std::string kind_word(PluginKind kind)
{
  switch (kind) {
    case PluginKind::shape:
      return "shape";
    case PluginKind::load_case:
      return "load_case";
    case PluginKind::optimizer:
      return "optimizer";
  }
  return "plugin";
}

/// Looks plugins up and notes those that are used.
PluginLookup recording_lookup(const Registry& registry, std::vector<Provenance::Plugin>& used)
{
  return [&registry, &used](PluginKind kind, const std::string& id,
                            std::string& error) -> const PluginTable* {
    try {
      const PluginTable& table = registry.find(kind, id);
      const bool known = std::any_of(used.begin(), used.end(), [&id](const auto& p) { return p.id == id; });
      if (!known) used.push_back({id, kind_word(kind), table.version});
      return &table;
    } catch (const InputError& problem) {
      error = problem.what();
      return nullptr;
    }
  };
}

using WeaveTexts = std::map<std::string, std::string>;

/// Looks weaves up and keeps what they hold: every variant is made of the same, whatever becomes of the file.
WeaveLookup recording_lookup(WeaveLookup weaves, std::shared_ptr<WeaveTexts> used)
{
  if (!weaves) return weaves;
  return [weaves = std::move(weaves), used = std::move(used)](
             const std::string& name, std::string& error) -> std::optional<std::string> {
    if (const auto known = used->find(name); known != used->end()) return known->second;
    std::optional<std::string> text = weaves(name, error);
    if (text) used->emplace(name, *text);
    return text;
  };
}

using Fingerprints = std::map<std::string, std::string>;

/// Length and 64-bit FNV-1a hash of a file: to notice that it was changed, not that someone hid that. Empty
/// where it cannot be read, which its plugin tells.
std::string fingerprint(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::uint64_t hash = 0xcbf29ce484222325U, length = 0;
  for (char c = 0; file.get(c); ++length) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return file.eof() ? fmt::format("{} bytes, {:016x}", length, hash) : std::string();
}

/// Takes the fingerprint of every file once.
FileObserver recording_files(std::shared_ptr<Fingerprints> files)
{
  return [files = std::move(files)](const std::string& written, const std::string& located) {
    if (!files->contains(written)) files->emplace(written, fingerprint(located));
  };
}

/// Runs `step`; what stops it becomes a problem at `pointer`.
template <class Step>
bool attempt(Diagnostics& diagnostics, const Experiment& experiment, const char* pointer, Step&& step)
{
  try {
    step();
    return true;
  } catch (const InputError& error) {
    diagnostics.problems.add(nearest_node(experiment.resolved, pointer), error.what());
  } catch (const ComputationError& error) {  // not even the rest state can be computed
    diagnostics.problems.add(nearest_node(experiment.resolved, pointer), error.what());
  }
  return false;
}

/// Rest state as used; problems of the cell otherwise.
bool prepare_scene(Loaded& loaded, Diagnostics& diagnostics)
{
  const Experiment& e = loaded.experiment;
  return attempt(diagnostics, e, "/cell",
                 [&] {
                   const Model model = make_model(e.scene, *e.load_case, e.solver.clearance);
                   const std::vector<std::string> wrong = rest_problems(e.scene, model, e.relax);
                   for (const std::string& problem : wrong)
                     diagnostics.problems.add(nearest_node(e.resolved, "/cell"), problem);
                   if (!wrong.empty()) return;
                   PreparedScene prepared = prepare_rest(e.scene, *e.load_case, e.solver.clearance);
                   loaded.scene = std::move(prepared.scene);
                   loaded.moved = prepared.moved;
                   loaded.start = std::move(prepared.start);
                 }) &&
         diagnostics.empty();
}

/// A target in a direction that links leave free can never be met.
void check_targets(const Loaded& loaded, Diagnostics& diagnostics)
{
  const std::size_t per = loaded.design->quantity == DesignQuantity::eta ? 2 : 1;
  for (std::size_t k = 0; k < per * loaded.design->targets.size(); ++k) {
    const auto& [task, bounded] = loaded.plan.bounded[k];
    if (bounded == "attained") continue;
    const std::string pointer = fmt::format("/design/targets/{}", k / per);
    diagnostics.problems.add(
        nearest_node(loaded.experiment.resolved, pointer),
        fmt::format(
            "{} is {}: links set no limit that a design could change",
            limit_name(loaded.experiment.load_case->sense_name(task.direction, task.sense), task.direction),
            bounded));
  }
}

void prepare_transition(Loaded& loaded, Diagnostics& diagnostics)
{
  const Experiment& e = loaded.experiment;
  loaded.transition = transition_job(e, loaded.scene, loaded.settings.schedule);
  for (const auto& [path, problem] : transition_problems(loaded.transition->spec)) {
    const std::string pointer = fmt::format("/transition/paths/{}", path);
    diagnostics.problems.add(nearest_node(e.resolved, pointer),
                             fmt::format("path '{}': {}", e.transition->paths[path].name, problem));
  }
}

void prepare_design(Loaded& loaded, Diagnostics& diagnostics)
{
  const Experiment& e = loaded.experiment;
  check_targets(loaded, diagnostics);
  attempt(diagnostics, e, "/design", [&] {
    DesignProblem problem(loaded.scene, *e.load_case, e.solver.clearance, loaded.settings, *loaded.design, 1,
                          [] { return true; });
    if (const std::string impossible = problem.impossible_hole(); !impossible.empty())
      diagnostics.problems.add(nearest_node(e.resolved, "/design/hole_clearance"), impossible);
    loaded.design_scene = with_rest(problem.current().spec, problem.current().model, problem.current().rest);
  });
}

}  // namespace

SceneSpec with_rest(const SceneSpec& spec, const Model& model, const State& rest)
{
  SceneSpec scene = spec;
  const std::vector<Pose> at = poses(model, rest);
  for (std::size_t k = 0; k < at.size(); ++k)
    scene.elements[k].rest = {at[k].position * model.length, at[k].rotation};
  return scene;
}

std::shared_ptr<const Registry> open_registry(const Options& options)
{
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : options.list("plugin-path")) folders.emplace_back(folder);
  return std::make_shared<Registry>(plugin_search_path(folders));
}

Loaded load(const Options& options)
{
  const std::string& file = options.positional();
  std::shared_ptr<const Registry> registry = open_registry(options);
  return load(std::move(registry), {file, read_text_file(file), options.list("set"), weave_lookup(file)});
}

Loaded load(std::shared_ptr<const Registry> registry, const ExperimentSource& source)
{
  Loaded loaded;
  loaded.registry = std::move(registry);
  Diagnostics diagnostics;
  const auto weaves = std::make_shared<WeaveTexts>();
  const auto files = std::make_shared<Fingerprints>();
  std::optional<Experiment> experiment =
      read_experiment({source.file, source.text, source.overrides, recording_lookup(source.weaves, weaves),
                       recording_files(files)},
                      recording_lookup(*loaded.registry, loaded.plugins), diagnostics);
  const auto stop_on_problems = [&diagnostics] {
    if (!diagnostics.empty()) throw ReportedProblems(diagnostics.text());
  };
  stop_on_problems();
  loaded.experiment = std::move(experiment.value());
  const Experiment& e = loaded.experiment;
  for (const Problem& problem : solver_problems(e))
    diagnostics.problems.add(nearest_node(e.resolved, problem.pointer), problem.message);
  if (meshes_without_contact(e)) stop_on_problems();  // the scene would say so again
  if (!prepare_scene(loaded, diagnostics)) stop_on_problems();

  if (e.task == Task::stability) {
    loaded.stability =
        load_stability(*e.stability, recording_lookup(*loaded.registry, loaded.plugins), diagnostics);
    stop_on_problems();
  }
  if (e.task == Task::sweep) {
    loaded.sweep = load_sweep(e, recording_lookup(*loaded.registry, loaded.plugins), diagnostics);
    stop_on_problems();
  }
  if (e.task == Task::chart) {
    loaded.chart = load_chart(e, recording_lookup(*loaded.registry, loaded.plugins), diagnostics);
    stop_on_problems();
  }
  if (e.stability || e.sweep || e.chart) loaded.weaves.assign(weaves->begin(), weaves->end());
  loaded.files.assign(files->begin(), files->end());
  loaded.settings = limit_settings(e.solver, loaded.scene, e.length_unit);
  loaded.settings.start = loaded.start;
  loaded.tasks = profile_tasks(e);
  if (e.task == Task::design) {
    loaded.design = design_spec(e);
    loaded.tasks = design_tasks(*loaded.design, loaded.tasks);
  }
  loaded.plan =
      make_plan(make_model(loaded.scene, *e.load_case, e.solver.clearance), loaded.tasks, loaded.settings);
  if (e.task == Task::transition) prepare_transition(loaded, diagnostics);
  if (loaded.design) prepare_design(loaded, diagnostics);
  stop_on_problems();
  return loaded;
}

}  // namespace hauberk::command
