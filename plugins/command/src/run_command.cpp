#include "chart_run.hpp"
#include "chart_summary.hpp"
#include "design_run.hpp"
#include "dispatch.hpp"
#include "interrupt.hpp"
#include "limits_run.hpp"
#include "plan_text.hpp"
#include "resume.hpp"
#include "stability_run.hpp"
#include "stability_summary.hpp"
#include "summary.hpp"
#include "sweep_run.hpp"
#include "transition_run.hpp"

#include <hauberk/experiment/expect.hpp>
#include <hauberk/results/atomic_file.hpp>
#include <hauberk/results/json_text.hpp>

#include <fmt/format.h>
#include <boost/program_options/value_semantic.hpp>

#include <cstdio>
#include <thread>

namespace hauberk::command {
namespace {

namespace po = boost::program_options;

constexpr int most_threads = 4096;

Options run_options()
{
  Options options("run EXPERIMENT.json [options]",
                  "Computes what the experiment asks for and writes it to a folder.", "EXPERIMENT.json");
  auto add = options.add().add_options();
  add("output,o", po::value<std::string>()->value_name("DIR"),
      "folder for the results; default: out/NAME-OF-THE-FILE");
  add("force", "replace results that the folder holds");
  add("resume", "go on from the partial results of the same experiment in the folder");
  add("threads", po::value<int>()->value_name("N"), "threads to use; default: all of the machine");
  add("quiet", "show no progress");
  options.add_experiment_options();
  return options;
}

unsigned thread_count(const Options& options)
{
  if (!options.has("threads")) return std::max(1U, std::thread::hardware_concurrency());
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
  return std::filesystem::path("out") / std::filesystem::path(options.positional()).stem();
}

void run_limits_task(const Loaded& loaded, unsigned threads, const Resumed& resumed, Progress& progress,
                     Output& output, RunResult& run)
{
  const Experiment& e = loaded.experiment;
  const Model model = make_model(loaded.scene, *e.load_case, e.solver.clearance);
  const LimitsJob job{&model,  &loaded.scene, loaded.tasks,  loaded.settings, e.load_case_plugin,
                      threads, "limits",      resumed.limits};
  output.keep(resumed.entries);
  const auto enter = [&](std::vector<LimitResult> limits) {
    run.limits = std::move(limits);
    run.profiles = profiles(run.limits, *e.load_case);
    run.boundary = boundary_of(e, loaded.settings, model.length, run.limits);
  };
  enter(run_limits(job, progress, [&](const std::vector<LimitResult>& so_far) {
    enter(so_far);
    output.write_sometimes(run);
  }));
}

/// Prints expectations that fail; true if there are any.
bool report_expectations(const Experiment& experiment, const boost::json::value& document)
{
  const std::vector<ExpectationFailure> failures = evaluate_expectations(experiment.expect, document);
  for (const ExpectationFailure& failure : failures)
    fmt::print("expected result missed: {}\n", failure.text());
  if (failures.empty() && !experiment.expect.empty())
    fmt::print("all {} expected results are met\n", experiment.expect.size());
  return !failures.empty();
}

constexpr const char* interrupted_note = "interrupted: these results are partial; go on with --resume\n";

void print_files(const Output& output, const std::vector<std::pair<std::string, std::string>>& files)
{
  std::string names = results_file;
  for (const auto& [what, name] : files) names += ", " + name;
  fmt::print("results in {}: {}\n", output.directory().string(), names);
}

/// The end of a run whose results are written: what came of it, on the terminal.
int conclude(const Loaded& loaded, Output& output, const std::string& summary,
             const std::vector<std::pair<std::string, std::string>>& files,
             std::chrono::steady_clock::time_point begin)
{
  if (!interrupted()) output.done();
  fmt::print("{}\n\n{}", loaded.experiment.name, summary);
  fmt::print("{:.2f} s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  const bool missed = !interrupted() && report_expectations(loaded.experiment, output.document());
  print_files(output, files);
  if (interrupted()) {
    fmt::print("{}", interrupted_note);
    return exit_interrupted;
  }
  return missed ? exit_failed : exit_done;
}

/// Whole run of a stability experiment. Cases that fail are what it is for: they do not fail the run, but an
/// `expect` about their counts may.
int run_stability_task(const Loaded& loaded, unsigned threads, Resumed& resumed, Progress& progress,
                       Output& output, const RunResult& base)
{
  const auto begin = std::chrono::steady_clock::now();
  StabilityMap map = resumed.stability ? std::move(*resumed.stability) : empty_map(loaded);
  run_stability(loaded, threads, progress, map,
                [&](const StabilityMap& so_far) { output.write_sometimes(base, so_far); });
  progress.clear();
  output.write(base, map);
  return conclude(loaded, output, stability_summary(map), stability_files(), begin);
}

/// Whole run of a sweep. Rows that are bad input are answers; those that failed make the run fail.
int run_sweep_task(const Loaded& loaded, unsigned threads, Resumed& resumed, Progress& progress,
                   Output& output, const RunResult& base)
{
  const auto begin = std::chrono::steady_clock::now();
  SweepTable table = resumed.sweep ? std::move(*resumed.sweep) : empty_table(loaded);
  run_sweep(loaded, threads, progress, table,
            [&](const SweepTable& so_far) { output.write_sometimes(base, so_far); });
  progress.clear();
  output.write(base, table);
  const int code = conclude(loaded, output, sweep_summary(table), sweep_files(), begin);
  return code == exit_done && any_failed(table) ? exit_failed : code;
}

/// Whole run of a chart. Points that fail are what it shows; a reference that fails, and runs that differ,
/// make the run fail.
int run_chart_task(const Loaded& loaded, unsigned threads, Resumed& resumed, Progress& progress,
                   Output& output, const RunResult& base)
{
  const auto begin = std::chrono::steady_clock::now();
  output.keep_load_average(resumed.load_average);
  PrecisionChart chart = resumed.chart ? std::move(*resumed.chart) : empty_chart(loaded);
  const ChartObserver observer{[&](const PrecisionChart& so_far) { output.write_sometimes(base, so_far); },
                               [&] { output.note_peak_memory(); }};
  run_chart(loaded, threads, progress, chart, observer);
  progress.clear();
  output.write(base, chart);
  const int code = conclude(loaded, output, chart_summary(chart), chart_files(), begin);
  return code == exit_done && any_failed(chart) ? exit_failed : code;
}

int run_transition_task(const Loaded& loaded, unsigned threads, Progress& progress, Output& output,
                        const RunResult& base)
{
  const auto begin = std::chrono::steady_clock::now();
  const TransitionResult result = run_transition(
      loaded.transition->spec, threads,
      [&progress](std::size_t done, std::size_t total) { progress.limits("transition", done, total); },
      [] { return !interrupted(); });
  progress.clear();
  output.write(base, result);
  if (!result.message.empty())
    throw ComputationError(
        fmt::format("{}; what was computed is in {}", result.message, output.directory().string()));
  return conclude(loaded, output, transition_summary(result), transition_files(), begin);
}

[[noreturn]] void fail_with_partial_results(const std::string& reason, Output& output, const RunResult& run)
{
  try {
    output.write(run);
  } catch (const ComputationError& error) {
    throw ComputationError(
        fmt::format("{}; and what was computed cannot be saved: {}", reason, error.what()));
  }
  throw ComputationError(fmt::format("{}; what was computed is in {}", reason, output.directory().string()));
}

/// Everything after the first file was written: from here on nothing is bad input.
void compute(const Loaded& loaded, unsigned threads, const Resumed& resumed, bool resuming,
             Progress& progress, Output& output, RunResult& run)
try {
  if (loaded.design)
    run_design_task(loaded, threads, resuming, progress, output, run);
  else
    run_limits_task(loaded, threads, resumed, progress, output, run);
} catch (const ComputationError& error) {
  fail_with_partial_results(error.what(), output, run);
} catch (const InputError& error) {
  fail_with_partial_results(error.what(), output, run);
}

int finish(const Loaded& loaded, Output& output, const RunResult& run, double seconds)
{
  fmt::print("{}", summary(loaded, run));
  fmt::print("{:.2f} s\n", seconds);
  if (interrupted()) {
    print_files(output, result_files(run));
    fmt::print("{}", interrupted_note);
    return exit_interrupted;
  }
  output.done();
  const bool missed = report_expectations(loaded.experiment, output.document());
  print_files(output, result_files(run));
  return missed || any_failed(run) ? exit_failed : exit_done;
}

/// Of a run that has nothing left to do.
int already_complete(const Loaded& loaded, const Resumed& resumed, const std::filesystem::path& folder)
{
  // The run may have been killed after its last result, before it had tidied up.
  remove_abandoned(folder);
  drop_previous(folder);
  drop_evaluations(folder);
  fmt::print("{}: complete already\n", (folder / results_file).string());
  bool failed = report_expectations(loaded.experiment, resumed.document);
  failed = failed || (resumed.sweep && any_failed(*resumed.sweep)) ||
           (resumed.chart && any_failed(*resumed.chart));
  for (const auto& limit : resumed.limits)
    failed = failed || limit->status == LimitStatus::failed || limit->status == LimitStatus::stalled;
  return failed ? exit_failed : exit_done;
}

}  // namespace

int run_command(const std::vector<std::string>& words)
{
  catch_interrupts();
  const auto begin = std::chrono::steady_clock::now();
  Options options = run_options();
  options.parse(words);
  const unsigned threads = thread_count(options);
  const std::filesystem::path folder = output_folder(options);
  const Loaded loaded = load(options);
  Resumed resumed;
  bool resuming = false;
  if (options.has("resume")) {
    if (std::optional<Resumed> found = read_resumed(folder, loaded)) {
      resumed = std::move(*found);
      resuming = true;
    }
  }
  if (resumed.complete) return already_complete(loaded, resumed, folder);
  // Killed before its first results.json, a run leaves other files: --resume starts anew over them.
  prepare_output_directory(folder, options.has("force") || options.has("resume"));

  if (!resuming) drop_evaluations(folder);
  Progress progress(Progress::detect(options.has("quiet")));
  if (options.has("resume")) {
    progress.note(!resuming           ? "nothing to resume: starting anew"
                  : loaded.design     ? "resuming: the search is repeated from its evaluations"
                  : loaded.transition ? "not finished: starting anew"
                  : resumed.stability ? "resuming: finished cases are kept"
                  : resumed.sweep     ? "resuming: finished rows are kept"
                  : resumed.chart     ? "resuming: finished runs are kept"
                                      : "resuming: finished limits are kept");
  }
  Output output(folder, loaded, threads, resuming, progress);
  output.keep_peak_memory(resumed.peak_memory_bytes);
  RunResult run;
  run.plan_json = write_json(boost::json::value(plan_json(loaded)));
  run.scene = loaded.scene;
  if (loaded.experiment.task == Task::stability)
    return run_stability_task(loaded, threads, resumed, progress, output, run);
  if (loaded.experiment.task == Task::sweep)
    return run_sweep_task(loaded, threads, resumed, progress, output, run);
  if (loaded.chart) return run_chart_task(loaded, threads, resumed, progress, output, run);
  if (loaded.transition) return run_transition_task(loaded, threads, progress, output, run);
  compute(loaded, threads, resumed, resuming, progress, output, run);
  progress.clear();
  output.write(run);
  return finish(loaded, output, run,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

}  // namespace hauberk::command
