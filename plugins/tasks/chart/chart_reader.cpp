#include "document/json_writer.hpp"
#include "document/node_access.hpp"
#include "tasks/chart/chart_section.hpp"
#include "tasks/variants/variants.hpp"

#include <hauberk/suggestion.hpp>

#include <algorithm>

namespace hauberk {

namespace {

/// What `set` of a section names must be something that a variant has.
void check_places(const Node& section, TaskFormats formats, Problems& problems)
{
  const Node* set = find_typed(section, "set", Node::Type::object);
  if (set == nullptr) return;
  for (const auto& [pointer, value] : set->members) {
    if (const std::string problem = place_without_effect(formats, pointer, "points", "set"); !problem.empty())
      problems.add(value, problem);
  }
}

void read_exact(const Node& given, Problems& problems, ChartScene& scene)
{
  if (given.is(Node::Type::number)) {
    scene.exact.emplace_back(given.number);
    return;
  }
  bool any = false;
  for (const Node& item : given.items) {
    const bool known = item.is(Node::Type::number);
    if (!known && !item.is(Node::Type::null)) problems.add(item, "expected a number or null");
    scene.exact.push_back(known ? std::optional(item.number) : std::nullopt);
    any = any || known;
  }
  if (!any) problems.add(given, "expected at least one number: without any there is no error");
}

ChartScene read_scene_entry(const Node& section, TaskFormats formats, Problems& problems)
{
  ChartScene scene;
  scene.name = string_or(section, "name", "");
  scene.set = read_set(section);
  check_places(section, formats, problems);
  const Node* exact = section.find("exact");
  const Node* reference = find_typed(section, "reference", Node::Type::object);
  if ((exact != nullptr) == (reference != nullptr))
    problems.add(section, exact != nullptr ? "expected either exact or reference, found both"
                                           : "expected exact or reference, found neither");
  if (exact != nullptr) read_exact(*exact, problems, scene);
  if (reference != nullptr) {
    check_places(*reference, formats, problems);
    scene.reference = read_set(*reference);
  }
  return scene;
}

/// Of a method that varies nothing there is one setting, without a name unless it is given one.
Variants read_settings(const Node& section, Problems& problems)
{
  if (section.find("vary") != nullptr) return read_variants(section, "setting", problems);
  Variants one{{""}, {read_set(section)}};
  if (const Node* labels = find_typed(section, "labels", Node::Type::array)) {
    check_length(labels, 1, "labels", "setting", problems);
    if (!labels->items.empty()) one.labels.front() = labels->items.front().string;
  }
  return one;
}

void check_labels(const Node& section, const std::vector<std::string>& labels, Problems& problems)
{
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (std::find(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(k), labels[k]) !=
        labels.begin() + static_cast<std::ptrdiff_t>(k))
      problems.add(section, "setting '" + labels[k] + "' is given twice; give labels");
  }
}

/// Numbers of the scenes that a method solves.
std::vector<std::size_t> read_scenes_of(const Node& section, const std::vector<ChartScene>& scenes,
                                        Problems& problems)
{
  std::vector<std::size_t> out;
  const Node* list = find_typed(section, "scenes", Node::Type::array);
  for (std::size_t k = 0; list == nullptr && k < scenes.size(); ++k) out.push_back(k);
  if (list == nullptr) return out;
  std::vector<std::string> known;
  known.reserve(scenes.size());
  for (const ChartScene& scene : scenes) known.push_back(scene.name);
  for (const Node& item : list->items) {
    const auto at = std::find(known.begin(), known.end(), item.string);
    const std::size_t scene = at - known.begin();
    if (at == known.end())
      problems.add(item, "unknown scene '" + item.string + "'" + suggestion(item.string, known));
    else if (std::find(out.begin(), out.end(), scene) != out.end())
      problems.add(item, "scene '" + item.string + "' is given twice");
    else
      out.push_back(scene);
  }
  std::sort(out.begin(), out.end());
  return out;
}

ChartMethod read_method(const Node& section, const std::vector<ChartScene>& scenes, TaskFormats formats,
                        Problems& problems)
{
  ChartMethod method;
  method.name = string_or(section, "name", "");
  check_places(section, formats, problems);
  Variants settings = read_settings(section, problems);
  check_labels(section, settings.labels, problems);
  method.labels = std::move(settings.labels);
  method.settings = std::move(settings.values);
  method.scenes = read_scenes_of(section, scenes, problems);
  return method;
}

std::vector<int> read_threads(const Node& section, Problems& problems)
{
  std::vector<int> out;
  const Node* list = find_typed(section, "threads", Node::Type::array);
  if (list == nullptr) return {1};
  for (const Node& item : list->items) {
    const int count = static_cast<int>(item.number);
    if (std::find(out.begin(), out.end(), count) != out.end())
      problems.add(item, std::to_string(count) + " threads are given twice");
    out.push_back(count);
  }
  return out;
}

void check_solved(const Node& list, const ExperimentChart& chart, Problems& problems)
{
  for (std::size_t k = 0; k < chart.scenes.size(); ++k) {
    const bool solved = std::any_of(chart.methods.begin(), chart.methods.end(), [k](const ChartMethod& m) {
      return std::find(m.scenes.begin(), m.scenes.end(), k) != m.scenes.end();
    });
    if (!solved) problems.add(list.items[k], "no method solves scene '" + chart.scenes[k].name + "'");
  }
}

}  // namespace

std::shared_ptr<const TaskSection> read_chart(Node& section, SectionContext& context)
{
  Problems& problems = context.problems;
  auto chart = std::make_shared<ExperimentChart>();
  ExperimentChart& out = *chart;
  out.base = context.base;
  out.repeats = int_or(section, "repeats", 3);
  out.threads = read_threads(section, problems);
  const Node* scenes = find_typed(section, "scenes", Node::Type::array);
  const Node* methods = find_typed(section, "methods", Node::Type::array);
  if (scenes == nullptr || methods == nullptr) return chart;
  const std::size_t before = problems.list().size();
  for (const Node& item : scenes->items)
    out.scenes.push_back(read_scene_entry(item, context.base.formats, problems));
  check_names(*scenes, out.scenes, "scene", problems);
  for (const Node& item : methods->items)
    out.methods.push_back(read_method(item, out.scenes, context.base.formats, problems));
  check_names(*methods, out.methods, "method", problems);
  if (problems.list().size() == before) check_solved(*scenes, out, problems);
  return chart;
}

VariantReading read_chart_scene(const ExperimentChart& chart, std::size_t scene, const PluginLookup& lookup,
                                Diagnostics& diagnostics)
{
  const ChartScene& from = chart.scenes[scene];
  std::vector<Assignment> values = from.set;
  if (from.reference) values.insert(values.end(), from.reference->begin(), from.reference->end());
  return read_variant(chart.base, values, from.name, "scene '" + from.name + "': ", lookup, diagnostics);
}

VariantReading read_chart_setting(const ExperimentChart& chart, std::size_t scene, std::size_t method,
                                  std::size_t setting, const PluginLookup& lookup, Diagnostics& diagnostics)
{
  const ChartScene& from = chart.scenes[scene];
  const ChartMethod& by = chart.methods[method];
  std::vector<Assignment> values = from.set;
  values.insert(values.end(), by.settings[setting].begin(), by.settings[setting].end());
  const std::string& label = by.labels[setting];
  const std::string named = label.empty() ? "" : ", setting '" + label + "'";
  return read_variant(chart.base, values, from.name + ", " + by.name + (label.empty() ? "" : ", " + label),
                      "scene '" + from.name + "', method '" + by.name + "'" + named + ": ", lookup,
                      diagnostics);
}

}  // namespace hauberk
