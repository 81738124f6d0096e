#include "run/limits_run.hpp"

#include "limits/boundary.hpp"
#include "run/interrupt.hpp"

#include <cmath>

namespace hauberk {

std::optional<BoundarySurface> boundary_of(const Experiment& experiment, const LimitSettings& settings,
                                           double length, const std::vector<LimitResult>& limits)
{
  if (experiment.directions.empty()) return std::nullopt;
  const double scale = std::pow(length, experiment.load_case->value_length_power());
  return boundary_surface(limits, experiment.triangles, *experiment.load_case,
                          further_than(settings) * scale);
}

namespace {

/// What a job is told by, and whom it tells how far it is.
LimitsObserver observer_of(const LimitsJob& job, Progress& progress)
{
  LimitsObserver observer;
  observer.keep_going = [] { return !interrupted(); };
  observer.on_start = [&job, &progress](std::size_t done, std::size_t total) {
    progress.limits(job.label + ", searches", done, total);
  };
  observer.on_lesson = [&job, &progress](int round, std::size_t done, std::size_t total) {
    progress.lessons(job.label, round, done, total);
  };
  observer.memory = job.memory;
  observer.on_states = job.on_states;
  observer.on_unreported = job.on_unreported;
  observer.is_enough = job.is_enough;
  return observer;
}

}  // namespace

std::vector<LimitResult> run_limits(const LimitsJob& job, Progress& progress, const LimitsSink& sink)
{
  const auto named = [&job](std::vector<LimitResult> limits) {
    for (LimitResult& limit : limits) limit.load_case = job.load_case;
    return limits;
  };
  LimitsObserver observer = observer_of(job, progress);
  observer.on_limit = [&](const std::vector<LimitResult>& limits) { sink(named(limits)); };
  return named(
      compute_limits(*job.model, *job.scene, job.tasks, job.settings, job.threads, observer, job.known));
}

void run_searches(const LimitsJob& job, Progress& progress, const Share& share)
{
  compute_searches(*job.model, *job.scene, job.tasks, job.settings, job.threads, observer_of(job, progress),
                   share);
}

}  // namespace hauberk
