#include "dispatch.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "say.hpp"
#include "tasks/job.hpp"

#include <fmt/format.h>

namespace hauberk::command {

Description plan_description()
{
  return {.name = "plan",
          .form = "EXPERIMENT.json",
          .line = "what will be modelled, and why; the rest state",
          .synopsis = "plan EXPERIMENT.json [options]",
          .summary = "Says what will be modelled and why, and describes the rest state. Computes no limit.",
          .more = "With `--json` it is the `plan` of results.json with the tightest pairs at rest.",
          .arguments = {experiment_argument()},
          .options = joined({json_option()}, experiment_options())};
}

int plan_command(const std::vector<std::string>& words)
{
  Options options(plan_description());
  options.parse(words);
  const Job job = open_job(options);
  ShownPlan shown = show_plan(job);
  if (options.has("json"))
    say_json(write_json(boost::json::value(std::move(shown.document))));
  else
    say("{}\nWork, without what limits learn from each other\n  {}\n", shown.text,
        text_of(job.task->work(job.plan)));
  return exit_done;
}

}  // namespace hauberk::command
