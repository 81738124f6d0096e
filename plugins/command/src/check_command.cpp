#include "dispatch.hpp"
#include "document/json_text.hpp"
#include "experiment_options.hpp"
#include "run/loose_parts.hpp"
#include "say.hpp"

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace hauberk::command {
namespace {

namespace json = boost::json;

/// Whoever asks for problems is answered by then.
constexpr std::chrono::milliseconds patience{1800};

constexpr const char* left_out =
    "the rest state, what is planned for it and variants were left out, as they take longer than two seconds; "
    "--thorough looks at them, and so does run";

/// What a thorough check finds, and how far it is.
struct Check {
  std::optional<std::string> summary;
  std::vector<std::string> warnings;
  std::exception_ptr problem;
};

Check thorough_check(const Options& options, std::atomic<bool>& is_read)
{
  Check out;
  try {
    read_alone(options);
    is_read = true;
    const Job job = open_job(options);
    out.warnings = loose_parts(job.prepared->scene);
    out.summary = job.task->check_line(job.plan);
  } catch (...) {
    out.problem = std::current_exception();
  }
  return out;
}

int tell_json(const Options& options, const Check& check)
{
  json::object out{{"file", options.positional()},
                   {"ok", true},
                   {"summary", nullptr},
                   {"left_out", nullptr},
                   {"problems", json::array()},
                   {"warnings", json::array(check.warnings.begin(), check.warnings.end())}};
  if (check.summary) out["summary"] = *check.summary;
  if (!check.summary && !check.problem) out["left_out"] = left_out;
  try {
    if (check.problem) std::rethrow_exception(check.problem);
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

int tell(const Options& options, const Check& check)
{
  if (options.has("json")) return tell_json(options, check);
  if (check.problem) std::rethrow_exception(check.problem);
  for (const std::string& warning : check.warnings)
    say_error("hauberk: warning: {}: {}\n", options.positional(), warning);
  if (check.summary)
    say("{}: no problems; {}\n", options.positional(), *check.summary);
  else
    say("{}: no problems in the file itself; {}\n", options.positional(), left_out);
  return exit_done;
}

}  // namespace

Description check_description()
{
  return {
      .name = "check",
      .form = "EXPERIMENT.json",
      .line = "every problem in the file at once, with its place",
      .synopsis = "check EXPERIMENT.json [options]",
      .summary = "Says everything that is wrong with an experiment.",
      .more =
          "It answers within two seconds, and says what it left out where the rest state or variants take "
          "longer. Elements of several bodies that nothing joins are warned of.",
      .arguments = {experiment_argument()},
      .options =
          joined({json_option(), {.name = "thorough", .help = "look at everything, however long it takes"}},
                 experiment_options())};
}

int check_command(const std::vector<std::string>& words)
{
  Options options(check_description());
  options.parse(words);
  std::atomic<bool> is_read = false;
  if (options.has("thorough")) return tell(options, thorough_check(options, is_read));
  std::packaged_task<Check()> task([&] { return thorough_check(options, is_read); });
  std::future<Check> answer = task.get_future();
  std::thread worker(std::move(task));
  // The file itself is always read to its end.
  while (answer.wait_for(patience) == std::future_status::timeout && !is_read) {
  }
  if (answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    worker.join();
    return tell(options, answer.get());
  }
  const int code = tell(options, {});
  // Nothing stops the worker, and it writes nothing.
  std::_Exit(std::fflush(stdout) == 0 ? code : exit_failed);
}

}  // namespace hauberk::command
