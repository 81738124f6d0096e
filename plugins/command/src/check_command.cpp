#include "dispatch.hpp"
#include "loading.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk::command {

int check_command(const std::vector<std::string>& words)
{
  Options options("check EXPERIMENT.json [options]", "Says everything that is wrong with an experiment.",
                  "EXPERIMENT.json");
  options.add_experiment_options();
  options.parse(words);
  const Loaded loaded = load(options);
  if (!loaded.stability.empty()) {
    fmt::print("{}: no problems; {} families, {} methods, {} scenes to solve\n", options.positional(),
               loaded.experiment.stability->families.size(), loaded.experiment.stability->methods.size(),
               loaded.stability.size());
    return exit_done;
  }
  if (!loaded.sweep.empty()) {
    const auto refused = std::count_if(loaded.sweep.begin(), loaded.sweep.end(),
                                       [](const VariantReading& row) { return !row.experiment; });
    fmt::print("{}: no problems; {} rows of {} limits{}\n", options.positional(), loaded.sweep.size(),
               loaded.tasks.size(), refused > 0 ? fmt::format(" ({} refused as input)", refused) : "");
    return exit_done;
  }
  if (loaded.chart) {
    const ExperimentChart& chart = *loaded.experiment.chart;
    fmt::print("{}: no problems; {} scenes, {} methods, {} points of {} runs\n", options.positional(),
               chart.scenes.size(), chart.methods.size(), loaded.chart->items.size() * chart.threads.size(),
               chart.repeats);
    return exit_done;
  }
  if (loaded.transition) {
    fmt::print("{}: no problems; {} paths, {} formulations\n", options.positional(),
               loaded.transition->spec.paths.size(), loaded.transition->spec.contacts.size());
    return exit_done;
  }
  const auto unbounded = std::count_if(loaded.plan.bounded.begin(), loaded.plan.bounded.end(),
                                       [](const auto& task) { return task.second == "unbounded"; });
  fmt::print(
      "{}: no problems; {} elements, {} limits{}{}\n", options.positional(), loaded.plan.elements,
      loaded.tasks.size(),
      unbounded > 0
          ? fmt::format(" ({} not held by links: only a try shows whether they are unbounded)", unbounded)
          : "",
      loaded.design ? fmt::format(", {} design variables", loaded.design->variables.size()) : "");
  return exit_done;
}

}  // namespace hauberk::command
