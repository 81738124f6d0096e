#include "presets.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk::command {
namespace {

/// Last activation distance of preset fast, L.
constexpr double fast_last = 1e-3;
/// Below this rounding of positions would show in gaps (L).
constexpr double least_last = 1e-11;

Schedule preset_schedule(const std::string& preset)
{
  Schedule schedule;  // accurate
  if (preset == "fast") schedule.last = fast_last;
  return schedule;
}

ContactChoice contact_choice(const std::string& name)
{
  if (name == "nearest") return ContactChoice::nearest;
  if (name == "arc") return ContactChoice::arc;
  return ContactChoice::automatic;
}

}  // namespace

std::string preset_problem(const std::string& preset)
{
  if (preset == "paper")
    return "preset 'paper' is not available in this version; use fast or accurate (measure 'paper' in "
           "load_case is "
           "available with both)";
  return {};
}

LimitSettings limit_settings(const ExperimentSolver& solver)
{
  LimitSettings settings;
  settings.contact = contact_choice(solver.contact);
  settings.schedule = preset_schedule(solver.preset);
  Schedule& schedule = settings.schedule;
  // Gaps at equilibrium are about a tenth of the activation distance, so 1 + value is as exact as the last
  // one.
  if (solver.tolerance) schedule.last = std::clamp(*solver.tolerance, least_last, schedule.first);
  if (solver.max_stages)
    schedule.last =
        std::max(schedule.last, schedule.first * std::pow(schedule.ratio, *solver.max_stages - 1));
  if (solver.max_iterations) schedule.most_iterations = *solver.max_iterations;
  settings.starts = solver.starts;
  settings.perturbation = solver.perturbation;
  settings.further_perturbation = std::max(settings.further_perturbation, solver.perturbation);
  settings.seed = solver.start_seed;
  return settings;
}

Schedule design_schedule()
{
  Schedule schedule;
  schedule.first = 0.1;
  schedule.ratio = 0.1;
  schedule.last = 1e-4;
  // Leaves forces, and so gradients, accurate to about a thousandth.
  schedule.last_tolerance = 1e-6;
  return schedule;
}

}  // namespace hauberk::command
