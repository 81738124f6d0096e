#include "maker/job_limits.hpp"

#include "run/interrupt.hpp"
#include "run/limits_run.hpp"

#include <hauberk/error.hpp>

namespace hauberk::maker {

std::vector<LimitResult> limits_of(const Job& job, unsigned threads, const std::string& label,
                                   Progress& progress)
{
  const Prepared& prepared = *job.prepared;
  LimitsJob limits;
  limits.model = &prepared.model;
  limits.scene = &prepared.scene;
  limits.tasks = job.task->limit_tasks();
  limits.settings = prepared.settings;
  limits.load_case = prepared.experiment.load_case_plugin;
  limits.threads = threads;
  limits.label = label;
  std::vector<LimitResult> out = run_limits(limits, progress, [](const std::vector<LimitResult>&) {});
  if (interrupted()) throw ComputationError("interrupted: the limits are not known, and nothing was written");
  return out;
}

}  // namespace hauberk::maker
