#include "variant_run.hpp"
#include "interrupt.hpp"
#include "limits_run.hpp"
#include "presets.hpp"
#include "tasks.hpp"

#include <hauberk/error.hpp>
#include <hauberk/limits/limits.hpp>
#include <hauberk/plan/plan.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hauberk::command {
namespace {

/// The rest state as it would be loaded. Throws InputError when there is none.
PreparedScene rest_of(const Experiment& e)
{
  if (const std::vector<Problem> problems = solver_problems(e); !problems.empty())
    throw InputError(problems.front().message);
  const Model model = make_model(e.scene, *e.load_case, e.solver.clearance);
  const std::vector<std::string> wrong = rest_problems(e.scene, model, e.relax);
  if (!wrong.empty()) throw InputError(fmt::format("{}", fmt::join(wrong, "; ")));
  return prepare_rest(e.scene, *e.load_case, e.solver.clearance);
}

}  // namespace

RunResult run_variant(const Experiment& e)
{
  PreparedScene prepared = rest_of(e);
  RunResult run;
  run.scene = std::move(prepared.scene);
  const Model model = make_model(run.scene, *e.load_case, e.solver.clearance);
  LimitsObserver observer;
  observer.keep_going = [] { return !interrupted(); };
  LimitSettings settings = limit_settings(e.solver, run.scene, e.length_unit);
  settings.start = std::move(prepared.start);
  run.limits = compute_limits(model, run.scene, profile_tasks(e), settings, 1, observer);
  run.profiles = profiles(run.limits, *e.load_case);
  run.boundary = boundary_of(e, settings, model.length, run.limits);
  return run;
}

}  // namespace hauberk::command
