#include "dispatch.hpp"
#include "experiment_options.hpp"

#include <fmt/format.h>

namespace hauberk::command {

int check_command(const std::vector<std::string>& words)
{
  Options options("check EXPERIMENT.json [options]", "Says everything that is wrong with an experiment.",
                  "EXPERIMENT.json");
  options.add_experiment_options();
  options.parse(words);
  const Job job = open_job(options);
  fmt::print("{}: no problems; {}\n", options.positional(), job.task->check_line(job.plan));
  return exit_done;
}

}  // namespace hauberk::command
