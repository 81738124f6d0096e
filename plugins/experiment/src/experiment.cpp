#include "document/check.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"
#include "document/read_file.hpp"
#include "extends.hpp"
#include "scene_reader.hpp"
#include "sections.hpp"
#include "values.hpp"
#include "weave.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/experiment.hpp>
#include <hauberk/experiment/fields.hpp>
#include <hauberk/experiment/overrides.hpp>

#include <algorithm>
#include <set>

namespace hauberk {

namespace {

const TaskFormat* format_named(TaskFormats formats, std::string_view name)
{
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [name](const TaskFormat& format) { return format.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

void read_task(const Node& root, TaskFormats formats, Problems& problems, Experiment& experiment)
{
  const Node* task = root.find("task");
  const TaskFormat* format = task == nullptr ? nullptr : format_named(formats, task->string);
  if (format == nullptr) return;
  experiment.task = format->name;
  if (root.find(format->name) == nullptr)
    problems.add(root, "missing key '" + experiment.task + "': task " + experiment.task + " needs it");
}

/// Where a weave cannot be expanded, what is wrong with all that it does not bring is told all the same.
void add_apart_from_weave(Node root, const Field& fields, const ExtraFieldsOf& extra, Problems& problems)
{
  Problems found;
  check_fields(root, fields, found, extra);
  for (const Problem& problem : found.list())
    if (!problem.pointer.starts_with("/cell") && !problem.pointer.starts_with("/elements") &&
        !problem.pointer.empty())
      problems.add(problem);
}

/// Of contact mesh: what the paper compares with.
constexpr int default_facets = 20;

/// Frozen for the whole run; 1 where the scene cannot say, so that later sections can still be checked.
double scene_length(const Node& root, const SceneSpec& scene, bool scene_complete, Problems& problems)
{
  if (!scene_complete) return 1.0;
  try {
    return characteristic_length(scene);
  } catch (const InputError& error) {
    problems.add(root.at("cell"), error.what());
  }
  return 1.0;
}

/// A task that brings directions has its final limits in these where the load case names none.
void complete_directions(Node& root, TaskFormats formats, Problems& problems, Experiment& experiment)
{
  Node* section = find_mutable(root, "load_case");
  if (section == nullptr) return;
  for (const char* key : {"directions_deg", "directions"}) {
    if (section->find(key) != nullptr) return;
    const std::string pointer = section->pointer + "/" + key;
    for (const Problem& problem : problems.list()) {
      if (pointer_within(problem.pointer, pointer)) return;  // given, but wrong
    }
  }
  const TaskFormat* format = format_named(formats, experiment.task);
  if (format == nullptr || !format->brings_directions) {
    problems.add(
        *section,
        "missing key 'directions_deg': expected an array of at least 1 numbers, or key 'directions'");
    return;
  }
  for (const std::shared_ptr<const TaskSection>& s : experiment.sections) {
    for (const double direction : s->own_directions()) experiment.directions_deg.push_back(direction);
  }
  if (!experiment.directions_deg.empty())
    set_default(*section, "directions_deg", numbers_node(experiment.directions_deg));
}

/// Whether a file's answers are the same whatever stands at a place: labels, and how answers are searched.
bool changes_no_answer(const std::string& pointer, TaskFormats formats)
{
  const auto within = [&pointer](const std::string& place) { return pointer_within(pointer, place); };
  if (pointer.starts_with("/solver/")) return !within("/solver/clearance");
  if (within("/seed") || within("/$schema") || within("/name") || within("/description")) return true;
  return std::any_of(formats.begin(), formats.end(), [&](const TaskFormat& format) {
    return std::any_of(format.search_keys.begin(), format.search_keys.end(), [&](std::string_view key) {
      return within("/" + std::string(format.name) + "/" + std::string(key));
    });
  });
}

/// A design is searched by the caller's optimizer, whatever its file names. False: there is none, as is
/// reported.
bool put_callers_optimizer(Node& root, Problems& problems)
{
  if (string_or(root, "task", "") != "design" || find_typed(root, "design", Node::Type::object) == nullptr) {
    problems.add({"", 0, "an optimizer is given, and this is no design: it would never be asked"});
    return false;
  }
  Node section = object_node();
  set_default(section, "plugin", string_node(callers_optimizer));
  set_value(root, "/design/optimizer", section);
  return true;
}

/// Empties what a file expects where overrides make another experiment of it and do not say what they expect
/// themselves.
void drop_what_other_expects(const ExperimentSource& source, Experiment& experiment)
{
  std::string other;
  for (const std::string& assignment : source.overrides) {
    const std::string pointer = assignment.substr(0, assignment.find('='));
    if (pointer_within(pointer, "/expect")) return;
    if (other.empty() && !changes_no_answer(pointer, source.formats)) other = pointer;
  }
  if (other.empty() || experiment.expect.empty()) return;
  experiment.expect.clear();
  for (Node* root : {&experiment.resolved, &experiment.expanded})
    find_mutable(*root, "expect")->items.clear();
  experiment.expect_of_other = other;
}

}  // namespace

std::optional<Experiment> read_experiment(const ExperimentSource& source, const PluginLookup& lookup,
                                          Diagnostics& diagnostics)
{
  diagnostics.file = source.file;
  Problems& problems = diagnostics.problems;
  std::optional<Node> root = read_jsonc(source.text, problems);
  if (!root || !extend(*root, source.file, diagnostics)) return std::nullopt;
  for (const std::string& assignment : source.overrides) apply_override(*root, assignment, diagnostics);
  if (root->find("extends") != nullptr) {
    diagnostics.problems.add({"/extends", 0, "cannot be set: a file says itself which one it extends"});
    return std::nullopt;
  }
  if (source.optimizer != nullptr && !put_callers_optimizer(*root, problems)) return std::nullopt;
  const std::string folder = std::filesystem::path(source.file).parent_path().string();
  std::optional<Experiment> experiment =
      read_tree(std::move(*root),
                {lookup, source.weaves, folder, source.files, source.formats, source.optimizer}, diagnostics);
  if (experiment) drop_what_other_expects(source, *experiment);
  return experiment;
}

std::optional<Experiment> read_tree(Node given, const Lookups& lookups, Diagnostics& diagnostics,
                                    bool* well_formed)
{
  Problems& problems = diagnostics.problems;
  if (well_formed) *well_formed = false;
  std::optional<Node> root(std::move(given));
  const bool has_variants =
      std::any_of(lookups.formats.begin(), lookups.formats.end(),
                  [&root](const TaskFormat& f) { return f.makes_variants && root->find(f.name) != nullptr; });
  const VariantBase base = has_variants ? variant_base(*root, lookups) : VariantBase{};
  put_values(*root, problems);
  std::set<std::string> plugin_files;
  PluginResolver plugins(
      lookups.plugins, lookups.folder,
      [&](const std::string& written, const std::string& located) {
        plugin_files.insert(written);
        if (lookups.files) lookups.files(written, located);
      },
      lookups.optimizer);
  const ExtraFieldsOf extra = [&](const Field& field, const Node& object, Problems& found) {
    return plugins.extra_fields(field, object, found);
  };
  const Field fields = expanded_fields(lookups.formats);
  if (!expand_weave(*root, lookups.weaves, problems)) {
    add_apart_from_weave(std::move(*root), fields, extra, problems);
    return std::nullopt;
  }
  if (!check_fields(*root, fields, problems, extra)) return std::nullopt;
  if (well_formed) *well_formed = problems.empty();

  Experiment experiment;
  experiment.has_variants = has_variants;
  experiment.name = string_or(*root, "name", "");
  if (const Node* name = root->find("name"); name != nullptr && name->string.empty()) {
    problems.add(*name, "expected a name, found \"\"");
  }
  experiment.length_unit = string_or(*root, "length_unit", "mm");
  experiment.seed = seed_or(*root, "seed", 1);
  read_task(*root, lookups.formats, problems, experiment);

  ReadScene scene = read_scene(*root, plugins, problems);
  experiment.scene = std::move(scene.spec);
  const bool scene_complete = problems.empty();
  experiment.scene.length = scene_length(*root, experiment.scene, scene_complete, problems);
  if (const Node* cell = root->find("cell")) experiment.relax = boolean_or(*cell, "relax", false);
  if (Node* solver = find_mutable(*root, "solver")) experiment.solver = read_solver(*solver, experiment.seed);
  if (experiment.solver.contact == "mesh")
    experiment.scene.facets = experiment.solver.facets.value_or(default_facets);
  const TaskFormat* task = format_named(lookups.formats, experiment.task);
  read_load_case(*root, plugins, task != nullptr && task->brings_directions, problems, experiment);
  SectionContext context{experiment, scene.tile_of, scene_complete, base, plugins, problems};
  std::vector<const TaskFormat*> of_sections;
  for (const TaskFormat& format : lookups.formats) {
    if (Node* section = find_mutable(*root, format.name)) {
      experiment.sections.push_back(format.read(*section, context));
      of_sections.push_back(&format);
    }
  }
  complete_directions(*root, lookups.formats, problems, experiment);
  if (const Node* expect = find_typed(*root, "expect", Node::Type::array)) {
    experiment.expect = read_expectations(*expect, problems);
  }
  if (!problems.empty()) return std::nullopt;
  for (std::size_t k = 0; k < of_sections.size(); ++k) {
    if (of_sections[k]->check != nullptr) of_sections[k]->check(*experiment.sections[k], *root, problems);
  }
  if (!problems.empty()) return std::nullopt;
  experiment.expanded = *root;
  // Variants are made from the weave again when this is read again.
  if (has_variants) {
    keep_weave(*root, base.file);
    const TaskFormat* const own = format_named(lookups.formats, experiment.task);
    if (own != nullptr && own->makes_variants) keep_values(*root, base.file);
  }
  experiment.resolved = std::move(*root);
  experiment.folder = lookups.folder;
  experiment.plugin_files.assign(plugin_files.begin(), plugin_files.end());
  return experiment;
}

std::string read_text_file(const std::string& path) { return read_whole_file(path, largest_text); }

Experiment load_experiment(const std::string& path, const std::vector<std::string>& overrides,
                           const PluginLookup& plugins, TaskFormats formats)
{
  Diagnostics diagnostics;
  std::optional<Experiment> experiment =
      read_experiment({path, read_text_file(path), overrides, {}, {}, formats}, plugins, diagnostics);
  if (!experiment) throw InputError(diagnostics.text());
  return std::move(*experiment);
}

}  // namespace hauberk
