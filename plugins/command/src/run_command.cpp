#include "dispatch.hpp"
#include "page_files.hpp"
#include "part_run.hpp"
#include "run/interrupt.hpp"
#include "run/machine.hpp"
#include "run_experiment.hpp"

#include <fmt/format.h>

#include <utility>

namespace hauberk::command {
namespace {

constexpr int most_threads = 4096;

Budget budget_of(const Options& options)
{
  Budget budget;
  for (const auto& [name, value] :
       {std::pair<const char*, double*>{"budget", &budget.evaluations}, {"budget-bytes", &budget.bytes}}) {
    if (!options.has(name)) continue;
    *value = options.get<double>(name);
    if (!(*value > 0.0))
      throw UsageError(fmt::format("--{}: expected a number above 0", name), options.usage());
  }
  return budget;
}

}  // namespace

unsigned threads_of(const Options& options)
{
  if (!options.has("threads")) return available_processors();
  const int n = options.get<int>("threads");
  if (n < 1 || n > most_threads)
    throw UsageError(fmt::format("--threads: expected a number from 1 to {}, found {}", most_threads, n),
                     options.usage());
  return static_cast<unsigned>(n);
}

std::filesystem::path output_folder(const Options& options)
{
  if (options.has("output")) {
    if (options.get<std::string>("output").empty())
      throw UsageError("--output: expected a folder", options.usage());
    return options.get<std::string>("output");
  }
  const std::filesystem::path name = std::filesystem::path(options.positional()).stem();
  if (name.empty() || name == "." || name == "..")
    throw UsageError(
        fmt::format("{}: its name gives no folder for results; give one with -o", options.positional()),
        options.usage());
  return std::filesystem::path("out") / name;
}

Description run_description()
{
  return {
      .name = "run",
      .form = "EXPERIMENT.json [-o DIR] [--force] [--threads N] [--set path=value ...]",
      .line = "compute what the experiment asks for",
      .synopsis = "run EXPERIMENT.json [options]",
      .summary = "Computes what the experiment asks for and writes it to a folder.",
      .arguments = {experiment_argument()},
      .options = joined(
          {{.name = "output",
            .letter = 'o',
            .takes = Takes::text,
            .value = "DIR",
            .help = "folder for the results; default: out/NAME-OF-THE-FILE",
            .offer = Offer::folders},
           {.name = "force",
            .help = "replace results that the folder holds",
            .more = "Without it they are refused. They stay in its folder `.hauberk-previous` until the "
                    "new run is done."},
           {.name = "resume",
            .help = "go on from the partial results of the same experiment in the folder",
            .more = "Where nothing is left to do it says so; where there are no results it starts anew."},
           {.name = "take-over",
            .takes = Takes::text,
            .value = "HOST:PID",
            .help = "take the folder from this run, which is no more",
            .more = "A run holds its folder until it ends, however it ends, as far as this machine knows; "
                    "whether one of another machine has ended it cannot know."},
           {.name = "threads",
            .takes = Takes::integer,
            .value = "N",
            .help = "threads to use; default: all processors that the process may use",
            .more = "Results do not depend on it."},
           {.name = "part",
            .takes = Takes::text,
            .value = "K/N",
            .help = "compute part K of N of the searches that stand alone, for `gather`",
            .more =
                "All parts write into the folder `parts` of the same DIR, from any machines that see it, in "
                "any order, at the same time or not; one that is interrupted goes on when it is started "
                "again. Rows of a sweep and scenes of a stability map are shared out, of limits their "
                "starts, of a design the limits before it and its starts. Tasks `chart` and `transition` "
                "cannot be divided."},
           {.name = "budget",
            .takes = Takes::real,
            .value = "N",
            .help = "evaluations of closest points that the run may take at least; default: 1e10",
            .more =
                "Counted before anything is computed: searches, times stages, times pairs that are near at "
                "rest. Most runs take ten to a hundred times as many; a processor does about a million in a "
                "second. A run beyond it is refused."},
           {.name = "budget-bytes",
            .takes = Takes::real,
            .value = "N",
            .help = "the same of memory; default: what this process may use"},
           {.name = "yes", .help = "go on beyond the budget"},
           {.name = "html",
            .help = "leave also `report.html`, a page that shows the fabric and its limits, to turn by hand",
            .more = "Its viewer is built by `share/setup.sh --viewer`, with node and npm."},
           {.name = "quiet", .help = "show no progress"}},
          experiment_options())};
}

int run_command(const std::vector<std::string>& words)
{
  catch_interrupts();
  RunRequest request;
  Options options(run_description());
  options.parse(words);
  request.threads = threads_of(options);
  request.folder = output_folder(options);
  request.force = options.has("force");
  request.resume = options.has("resume");
  request.quiet = options.has("quiet");
  if (options.has("take-over")) request.take_over = options.get<std::string>("take-over");
  std::optional<Share> share;
  if (options.has("part")) share = part_of(options);
  if (share && options.has("html"))
    throw UsageError("--html: a part has no page; give it to `gather`", options.usage());
  Job job = [&options] {
    const NothingToLose scope;
    return open_job(options);
  }();
  warn_of_plugins(*job.prepared);
  warn_of_loose_parts(*job.prepared);
  if (options.has("html")) request.further = page_of_run(job, installed_page_parts());
  if (!options.has("yes"))
    refuse_beyond(budget_of(options),
                  job.task->work(job.plan).times(share ? 1.0 / static_cast<double>(share->count) : 1.0));
  if (share) return run_part(job, *share, options, request);
  return run_experiment(job, request);
}

}  // namespace hauberk::command
