#include "dispatch.hpp"
#include "plan_text.hpp"

#include <hauberk/results/json_text.hpp>

#include <fmt/format.h>

namespace hauberk::command {

int plan_command(const std::vector<std::string>& words)
{
  Options options("plan EXPERIMENT.json [options]",
                  "Says what will be modelled and why, and describes the rest state. Computes no limit.",
                  "EXPERIMENT.json");
  options.add().add_options()("json", "as JSON, like `plan` in results.json");
  options.add_experiment_options();
  options.parse(words);
  const Loaded loaded = load(options);
  fmt::print("{}",
             options.has("json") ? write_json(boost::json::value(plan_json(loaded))) : plan_text(loaded));
  return exit_done;
}

}  // namespace hauberk::command
