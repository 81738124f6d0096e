#include "tasks/chart/chart_loading.hpp"

#include "run/limit_tasks.hpp"
#include "run/nearest_node.hpp"
#include "tasks/chart/chart_section.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

/// The scene as its reference has it, or as it is.
VariantReading load_scene(const Experiment& e, std::size_t scene, const PluginLookup& lookup,
                          Diagnostics& diagnostics)
{
  const ChartScene& from = e.section<ExperimentChart>()->scenes[scene];
  const std::string pointer = fmt::format("/chart/scenes/{}", scene);
  VariantReading reading = read_chart_scene(*e.section<ExperimentChart>(), scene, lookup, diagnostics);
  if (!reading.refusal.empty()) {
    diagnostics.problems.add(nearest_node(e.resolved, pointer),
                             fmt::format("scene '{}': {}", from.name, reading.refusal));
  }
  if (!reading.experiment) return reading;
  const std::size_t limits = profile_tasks(*reading.experiment).size();
  if (!from.exact.empty() && from.exact.size() != limits) {
    diagnostics.problems.add(
        nearest_node(e.resolved, pointer + "/exact"),
        fmt::format("expected {} exact values, one per limit, found {}", limits, from.exact.size()));
  }
  return reading;
}

bool same_limits(const Experiment& a, const Experiment& b)
{
  const std::vector<LimitTask> of_a = profile_tasks(a), of_b = profile_tasks(b);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                    [](const LimitTask& x, const LimitTask& y) {
                      return x.direction == y.direction && x.sense == y.sense;
                    });
}

void load_settings(const Experiment& e, std::size_t scene, std::size_t method, const PluginLookup& lookup,
                   Diagnostics& diagnostics, LoadedChart& out)
{
  const ChartMethod& by = e.section<ExperimentChart>()->methods[method];
  for (std::size_t k = 0; k < by.settings.size(); ++k) {
    const std::size_t before = diagnostics.problems.list().size();
    VariantReading reading =
        read_chart_setting(*e.section<ExperimentChart>(), scene, method, k, lookup, diagnostics);
    if (reading.experiment && !same_limits(*reading.experiment, *out.scenes[scene].experiment)) {
      diagnostics.problems.add(
          nearest_node(e.resolved, fmt::format("/chart/methods/{}", method)),
          fmt::format(
              "method '{}' has other limits than scene '{}': it may set how they are found, not which "
              "they are",
              by.name, e.section<ExperimentChart>()->scenes[scene].name));
    }
    // What is wrong with one setting is wrong with all, as a rule.
    if (diagnostics.problems.list().size() > before) return;
    out.items.push_back({scene, method, k, std::move(reading)});
  }
}

}  // namespace

LoadedChart load_chart(const Experiment& e, const PluginLookup& lookup, Diagnostics& diagnostics)
{
  const ExperimentChart& chart = *e.section<ExperimentChart>();
  LoadedChart out;
  for (std::size_t scene = 0; scene < chart.scenes.size(); ++scene) {
    out.scenes.push_back(load_scene(e, scene, lookup, diagnostics));
    for (std::size_t m = 0; m < chart.methods.size() && out.scenes.back().experiment; ++m) {
      const std::vector<std::size_t>& solved = chart.methods[m].scenes;
      if (std::find(solved.begin(), solved.end(), scene) != solved.end())
        load_settings(e, scene, m, lookup, diagnostics, out);
    }
  }
  return out;
}

}  // namespace hauberk
