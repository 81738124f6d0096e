#include "dispatch.hpp"
#include "options.hpp"
#include "run/progress.hpp"
#include "say.hpp"

#include <hauberk/conformance/isolated.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk::command {
namespace {

constexpr std::uint64_t most_seeds = 1000;

std::string text_of(const std::vector<conformance::Report>& reports)
{
  std::string out;
  for (const conformance::Report& report : reports) out += (out.empty() ? "" : "\n") + report.text();
  return out;
}

/// Of a library with several plugins an array.
std::string json_of(const std::vector<conformance::Report>& reports)
{
  if (reports.size() == 1 && !reports.front().one_of_several) return reports.front().json();
  std::string out;
  for (const conformance::Report& report : reports) out += (out.empty() ? "[\n" : ",\n") + report.json();
  return out + "]\n";
}

}  // namespace

Description conform_description()
{
  return {
      .name = "plugins conform",
      .line = "check that a plugin does what plugins must do",
      .synopsis = "plugins conform FILE.so [options]",
      .summary =
          "Checks that a plugin does what plugins must do, each check in a process of its own; of a library "
          "with several plugins all of them. "
          "Exits with 1 when anything fails. The plugin is run: do not check what you would not run.",
      .arguments = {{.name = "FILE.so", .offer = Offer::libraries}},
      .options = {{.name = "plugin",
                   .takes = Takes::text,
                   .value = "ID",
                   .help = "one of the plugins of a library of several; by default all of them"},
                  {.name = "filter",
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
                  {.name = "quiet", .help = "show no progress"},
                  {.name = "json", .help = "the report as JSON"}}};
}

int conform_command(const std::vector<std::string>& words)
{
  Options options(conform_description());
  options.parse(words);
  conformance::Conditions conditions;
  conditions.in_process = options.has("in-process");
  if (options.has("plugin")) conditions.plugin = options.get<std::string>("plugin");
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
  Progress progress(Progress::detect(options.has("quiet")));
  conditions.on_check = [&progress](const std::string& check, std::size_t done, std::size_t total) {
    progress.checks(check, done, total);
  };
  const auto reports = conformance::conform_all(options.positional(), conditions);
  progress.clear();
  if (options.has("json"))
    say_json(json_of(reports));
  else
    say("{}", text_of(reports));
  const auto passed = [](const conformance::Report& report) { return report.passed(); };
  return std::all_of(reports.begin(), reports.end(), passed) ? exit_done : exit_failed;
}

}  // namespace hauberk::command
