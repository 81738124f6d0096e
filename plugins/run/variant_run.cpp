#include "run/variant_run.hpp"

#include "run/interrupt.hpp"
#include "run/limit_tasks.hpp"
#include "run/limits_run.hpp"
#include "run/presets.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hauberk {

PreparedVariant prepare_variant(const Experiment& experiment)
{
  const Experiment& e = experiment;
  if (const std::vector<Problem> problems = solver_problems(e); !problems.empty())
    throw InputError(problems.front().message);
  std::vector<std::string> wrong;
  PreparedVariant out{scene_at_rest(e, wrong), profile_tasks(e)};
  if (!wrong.empty()) throw InputError(fmt::format("{}", fmt::join(wrong, "; ")));
  return out;
}

VariantLimits solve_variant(const PreparedVariant& prepared, unsigned threads, SearchMemory* memory)
{
  VariantLimits out;
  LimitsObserver observer;
  observer.keep_going = [] { return !interrupted(); };
  observer.on_unreported = [&out](const std::vector<LimitResult>& limits) { out.unreported = limits; };
  observer.memory = memory;
  observer.on_states = [&out](const auto& states) { out.states = states; };
  out.limits =
      compute_limits(prepared.model, prepared.scene, prepared.tasks, prepared.settings, threads, observer);
  // A variant is done as a whole or again: what others were still teaching its limits is not kept apart.
  for (LimitResult& limit : out.limits) {
    if (!limit.confidence.is_final()) limit.status = LimitStatus::interrupted;
  }
  return out;
}

RunResult variant_result(const Experiment& experiment, PreparedVariant prepared, VariantLimits solved)
{
  RunResult run;
  run.limits = std::move(solved.limits);
  run.profiles = profiles(run.limits, *experiment.load_case);
  run.boundary = boundary_of(experiment, prepared.settings, prepared.model.length, run.limits);
  run.scene = std::move(prepared.scene);
  return run;
}

RunResult run_variant(const Experiment& experiment, SearchMemory* memory)
{
  PreparedVariant prepared = prepare_variant(experiment);
  VariantLimits solved = solve_variant(prepared, 1, memory);
  return variant_result(experiment, std::move(prepared), std::move(solved));
}

}  // namespace hauberk
