#include "dispatch.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "run/plan_text.hpp"
#include "tasks/job.hpp"

#include <fmt/format.h>

namespace hauberk::command {

int plan_command(const std::vector<std::string>& words)
{
  Options options("plan EXPERIMENT.json [options]",
                  "Says what will be modelled and why, and describes the rest state. Computes no limit.",
                  "EXPERIMENT.json");
  options.add_json_option();
  options.add_experiment_options();
  options.parse(words);
  const Job job = open_job(options);
  fmt::print("{}", options.has("json") ? write_json(boost::json::value(plan_document(job)))
                                       : plan_text(*job.prepared, job.plan, job.task->plan()));
  return exit_done;
}

}  // namespace hauberk::command
