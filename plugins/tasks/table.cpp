#include "tasks/table.hpp"

#include "results/document.hpp"
#include "results/timings.hpp"
#include "tasks/chart/chart_section.hpp"
#include "tasks/chart/chart_task.hpp"
#include "tasks/design/design_section.hpp"
#include "tasks/design/design_task.hpp"
#include "tasks/limits/limit_files.hpp"
#include "tasks/limits/limits_task.hpp"
#include "tasks/stability/stability_section.hpp"
#include "tasks/stability/stability_task.hpp"
#include "tasks/sweep/sweep_section.hpp"
#include "tasks/sweep/sweep_task.hpp"
#include "tasks/transition/transition_section.hpp"
#include "tasks/transition/transition_task.hpp"

#include <algorithm>
#include <array>

namespace hauberk {
namespace {

constexpr std::array table{Task{"limits", limit_file_names, &prepare_limits},
                           Task{"design", design_file_names, &prepare_design},
                           Task{"sweep", sweep_file_names, &prepare_sweep},
                           Task{"chart", chart_file_names, &prepare_chart},
                           Task{"stability", stability_file_names, &prepare_stability},
                           Task{"transition", transition_file_names, &prepare_transition}};

constexpr std::array<std::string_view, 4> design_search_keys{"optimizer", "starts", "perturbation",
                                                             "max_iterations"};

constexpr std::array formats{
    TaskFormat{.name = "design",
               .field = &design_field,
               .read = &read_design,
               .search_keys = design_search_keys,
               .brings_directions = true},
    TaskFormat{.name = "sweep",
               .field = &sweep_field,
               .read = &read_sweep,
               .check = &check_sweep,
               .makes_variants = true},
    TaskFormat{.name = "chart", .field = &chart_field, .read = &read_chart, .makes_variants = true},
    TaskFormat{
        .name = "stability", .field = &stability_field, .read = &read_stability, .makes_variants = true},
    TaskFormat{.name = "transition", .field = &transition_field, .read = &read_transition}};

}  // namespace

TaskFormats task_formats() { return formats; }

std::span<const Task> all_tasks() { return table; }

const Task& task_named(std::string_view name)
{
  return *std::find_if(table.begin(), table.end(), [name](const Task& task) { return task.name == name; });
}

std::vector<const char*> result_names()
{
  std::vector<const char*> out{results_file, timings_file, page_file};
  for (const Task& task : table) out.insert(out.end(), task.file_names.begin(), task.file_names.end());
  return out;
}

}  // namespace hauberk
