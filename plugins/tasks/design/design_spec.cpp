#include "tasks/design/design_spec.hpp"

#include "run/presets.hpp"
#include "tasks/design/design_section.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

bool same(const LimitTask& a, const LimitTask& b)
{
  return a.sense == b.sense && on_one_line(a.direction, b.direction);
}

DesignQuantity quantity_of(const std::string& name)
{
  if (name == "eta") return DesignQuantity::eta;
  return name == "compress" ? DesignQuantity::negative : DesignQuantity::positive;
}

}  // namespace

DesignSpec design_spec(const Experiment& experiment)
{
  const ExperimentDesign& from = *experiment.section<ExperimentDesign>();
  DesignSpec design;
  design.quantity = quantity_of(from.quantity);
  design.quantity_name = from.quantity;
  for (const ExperimentVariable& v : from.variables) {
    DesignVariable variable{v.name, {}, v.lower, v.upper};
    for (const ParameterRef& p : v.parameters) variable.entries.emplace_back(p.element, p.parameter);
    design.variables.push_back(std::move(variable));
  }
  for (const ExperimentTarget& t : from.targets)
    design.targets.push_back({t.direction_deg, t.value, t.weight, t.aim});
  design.hole_clearance = from.hole_clearance;
  design.rest_clearance = from.rest_clearance;
  design.value = from.plain_value ? DesignValue::plain : DesignValue::less_contact;
  design.starts = from.starts;
  design.perturbation = from.perturbation;
  design.seed = experiment.seed;
  design.schedule = design_schedule();
  design.tolerance = from.tolerance;
  return design;
}

std::vector<LimitTask> design_tasks(const DesignSpec& design, const std::vector<LimitTask>& profile)
{
  std::vector<LimitTask> tasks = target_limits(design).tasks;
  for (const LimitTask& t : profile) {
    const bool known =
        std::any_of(tasks.begin(), tasks.end(), [&t](const LimitTask& k) { return same(k, t); });
    if (!known) tasks.push_back(t);
  }
  return tasks;
}

std::vector<Problem> design_solver_problems(const ExperimentSolver& solver)
{
  std::vector<Problem> out;
  const auto refuse = [&out](const char* key) {
    out.push_back({fmt::format("/solver/{}", key), 0,
                   fmt::format("{} is for limits only in this version; remove it from a design", key)});
  };
  if (solver.preset == "paper") {
    out.push_back({"/solver/preset", 0,
                   "preset 'paper' computes limits only in this version; use accurate for a design"});
  } else {
    if (solver.finite_target) refuse("finite_target");
    if (solver.ccd == "sampled") refuse("ccd");
    if (solver.closest_points == "sampled") refuse("closest_points");
  }
  if (solver.contact == "constrained" || solver.contact == "mesh") {
    out.push_back(
        {"/solver/contact", 0,
         fmt::format("contact '{}' is for limits only; use auto or arc for a design", solver.contact)});
  }
  return out;
}

}  // namespace hauberk
