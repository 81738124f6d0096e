#include "dispatch.hpp"
#include "options.hpp"

#include <hauberk/conformance/isolated.hpp>

#include <fmt/format.h>

#include <cmath>

namespace hauberk::command {
namespace {

constexpr std::uint64_t most_seeds = 1000;

}  // namespace

Description conform_description()
{
  return {
      .name = "plugins conform",
      .line = "check that a plugin does what plugins must do",
      .synopsis = "plugins conform FILE.so [options]",
      .summary =
          "Checks that a plugin does what plugins must do, each check in a process of its own. "
          "Exits with 1 when anything fails. The plugin is run: do not check what you would not run.",
      .arguments = {{.name = "FILE.so", .offer = Offer::libraries}},
      .options = {{.name = "filter",
                   .takes = Takes::text,
                   .value = "REGEX",
                   .help = "only checks whose name matches"},
                  {.name = "section",
                   .takes = Takes::text,
                   .value = "JSON",
                   .help = "section of an experiment to make it with, for instance "
                           "'{\"parameters\": {\"ring.R\": 5}}'"},
                  {.name = "seed", .takes = Takes::natural, .value = "N", .help = "what is drawn; default 1"},
                  {.name = "seeds",
                   .takes = Takes::natural,
                   .value = "K",
                   .help = "each check with K seeds, from that of --seed on; default 1"},
                  {.name = "seconds",
                   .takes = Takes::real,
                   .value = "LIMIT",
                   .help = "longest processor time of a run of a check; default 60"},
                  {.name = "in-process", .help = "in this process, without a time limit: for debuggers"},
                  {.name = "json", .help = "the report as JSON"}}};
}

int conform_command(const std::vector<std::string>& words)
{
  Options options(conform_description());
  options.parse(words);
  conformance::Conditions conditions;
  conditions.in_process = options.has("in-process");
  if (options.has("filter")) conditions.filter = options.get<std::string>("filter");
  if (options.has("section")) conditions.setup.section = options.get<std::string>("section");
  if (options.has("seed")) conditions.seed = options.get<std::uint64_t>("seed");
  if (options.has("seeds")) {
    const auto seeds = options.get<std::uint64_t>("seeds");
    if (seeds < 1 || seeds > most_seeds)
      throw UsageError(fmt::format("--seeds: expected a number from 1 to {}", most_seeds), options.usage());
    conditions.seeds = static_cast<int>(seeds);
  }
  if (options.has("seconds")) conditions.seconds = options.get<double>("seconds");
  if (!(conditions.seconds > 0.0 && conditions.seconds <= 1e6))
    throw UsageError("--seconds: expected a number in (0, 1e6]", options.usage());
  const conformance::Report report = conformance::conform(options.positional(), conditions);
  fmt::print("{}", options.has("json") ? report.json() : report.text());
  return report.passed() ? exit_done : exit_failed;
}

}  // namespace hauberk::command
