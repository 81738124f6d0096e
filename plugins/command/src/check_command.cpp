#include "dispatch.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "say.hpp"

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk::command {
namespace {

namespace json = boost::json;

/// {file, ok, summary, problems: [{pointer, line, message}]}.
int check_as_json(const Options& options)
{
  json::object out{
      {"file", options.positional()}, {"ok", true}, {"summary", nullptr}, {"problems", json::array()}};
  try {
    const Job job = open_job(options);
    out["summary"] = job.task->check_line(job.plan);
  } catch (const ReportedProblems& error) {
    out["ok"] = false;
    for (const Problem& p : error.problems()) {
      const json::value line = p.line > 0 ? json::value(p.line) : json::value(nullptr);
      out["problems"].as_array().push_back({{"pointer", p.pointer}, {"line", line}, {"message", p.message}});
    }
  }
  say_json(write_json(out));
  return out["ok"].as_bool() ? exit_done : exit_bad_input;
}

}  // namespace

Description check_description()
{
  return {.name = "check",
          .form = "EXPERIMENT.json",
          .line = "every problem in the file at once, with its place",
          .synopsis = "check EXPERIMENT.json [options]",
          .summary = "Says everything that is wrong with an experiment.",
          .arguments = {experiment_argument()},
          .options = joined({json_option()}, experiment_options())};
}

int check_command(const std::vector<std::string>& words)
{
  Options options(check_description());
  options.parse(words);
  if (options.has("json")) return check_as_json(options);
  const Job job = open_job(options);
  say("{}: no problems; {}\n", options.positional(), job.task->check_line(job.plan));
  return exit_done;
}

}  // namespace hauberk::command
