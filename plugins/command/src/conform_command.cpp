#include "dispatch.hpp"
#include "options.hpp"

#include <hauberk/conformance/isolated.hpp>

#include <boost/program_options/value_semantic.hpp>
#include <fmt/format.h>

#include <cmath>

namespace hauberk::command {

int conform_command(const std::vector<std::string>& words)
{
  namespace po = boost::program_options;
  Options options(
      "plugins conform FILE.so [options]",
      "Checks that a plugin does what plugins must do, each check in a process of its own. Exits with 1 "
      "when anything fails. The plugin is run: do not check what you would not run.",
      "FILE.so");
  options.add().add_options()("filter", po::value<std::string>()->value_name("REGEX"),
                              "only checks whose name matches")(
      "section", po::value<std::string>()->value_name("JSON"),
      "section of an experiment to make it with, for instance '{\"parameters\": {\"ring.R\": 5}}'")(
      "seed", po::value<std::uint64_t>()->value_name("N"), "what is drawn; default 1")(
      "seconds", po::value<double>()->value_name("LIMIT"), "longest time of a check; default 60")(
      "in-process", "in this process, without a time limit: for debuggers")("json", "the report as JSON");
  options.parse(words);
  conformance::Conditions conditions;
  conditions.in_process = options.has("in-process");
  if (options.has("filter")) conditions.filter = options.get<std::string>("filter");
  if (options.has("section")) conditions.setup.section = options.get<std::string>("section");
  if (options.has("seed")) conditions.seed = options.get<std::uint64_t>("seed");
  if (options.has("seconds")) conditions.seconds = options.get<double>("seconds");
  if (!(conditions.seconds > 0.0 && conditions.seconds <= 1e6))
    throw UsageError("--seconds: expected a number in (0, 1e6]", options.usage());
  const conformance::Report report = conformance::conform(options.positional(), conditions);
  fmt::print("{}", options.has("json") ? report.json() : report.text());
  return report.passed() ? exit_done : exit_failed;
}

}  // namespace hauberk::command
