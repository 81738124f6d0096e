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

LimitsProgress shown_as(const std::string& label, Progress& progress)
{
  return {[label, &progress](std::size_t done, std::size_t total) { progress.limits(label, done, total); },
          [label, &progress](int round, std::size_t done, std::size_t total) {
            progress.lessons(label, round, done, total);
          }};
}

std::vector<LimitResult> run_limits(const LimitsJob& job, Progress& progress, const LimitsSink& sink)
{
  const auto named = [&job](std::vector<LimitResult> limits) {
    for (LimitResult& limit : limits) limit.load_case = job.load_case;
    return limits;
  };
  LimitsObserver observer;
  observer.keep_going = [] { return !interrupted(); };
  static_cast<LimitsProgress&>(observer) = shown_as(job.label, progress);
  observer.memory = job.memory;
  observer.on_states = job.on_states;
  observer.on_unreported = job.on_unreported;
  observer.on_limit = [&](const std::vector<LimitResult>& limits) { sink(named(limits)); };
  return named(
      compute_limits(*job.model, *job.scene, job.tasks, job.settings, job.threads, observer, job.known));
}

void run_searches(const LimitsJob& job, Progress& progress, const Share& share)
{
  LimitsObserver observer;
  observer.keep_going = [] { return !interrupted(); };
  static_cast<LimitsProgress&>(observer) = shown_as(job.label, progress);
  observer.memory = job.memory;
  compute_searches(*job.model, *job.scene, job.tasks, job.settings, job.threads, observer, share);
}

}  // namespace hauberk
