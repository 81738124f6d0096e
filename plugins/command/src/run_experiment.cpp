#include "run_experiment.hpp"

#include "dispatch.hpp"
#include "results/timings.hpp"
#include "run/folder_lock.hpp"
#include "run/interrupt.hpp"
#include "run/memory.hpp"
#include "run/provenance.hpp"
#include "run/run_folder.hpp"
#include "say.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/expect.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hauberk::command {
namespace {

/// Prints expectations that fail; true if there are any.
bool report_expectations(const Experiment& experiment, const boost::json::value& document)
{
  const std::vector<ExpectationFailure> failures = evaluate_expectations(experiment.expect, document);
  for (const ExpectationFailure& failure : failures) say("expected result missed: {}\n", failure.text());
  if (!experiment.expect_of_other.empty())
    say("not checked: what the file expects, as --set {} makes another experiment of it\n",
        experiment.expect_of_other);
  if (failures.empty() && !experiment.expect.empty())
    say("all {} expected results are met\n", experiment.expect.size());
  return !failures.empty();
}

constexpr const char* interrupted_note = "interrupted: these results are partial; go on with --resume\n";

/// What partial results in a folder leave to be done.
enum class Left { everything, something, nothing };

struct Former {
  Left left = Left::everything;
  boost::json::value document;  ///< unless everything is left
};

/// What the provenance tells of the runs that this one goes on from.
void keep_former(const boost::json::value& document, Provenance& provenance)
{
  const boost::json::object& then = document.at("provenance").as_object();
  if (const boost::json::value* peak = then.if_contains("peak_memory_bytes"))
    provenance.peak_memory_bytes = peak->to_number<std::int64_t>();
  if (!provenance.machine) return;
  const boost::json::value& load = then.at("machine").at("load_average");
  if (load.is_null()) return;
  std::optional<double>& now = provenance.machine->load_average;
  now = std::max(now.value_or(load.to_number<double>()), load.to_number<double>());
}

/// Takes over what the folder holds of the same experiment. Throws InputError when it cannot be read, or was
/// computed from another experiment or by another version of the program.
Former resume(const std::filesystem::path& folder, Job& job, Provenance& provenance)
{
  Former former;
  const std::filesystem::path file = folder / results_file;
  if (!std::filesystem::exists(file)) return former;
  try {
    former.document = read_timed_results(file, say_times_lost);
    check_origin(former.document, *job.prepared);
    const std::optional<bool> as_written = is_as_written(folder);
    if (as_written == false)
      throw InputError(
          "it is not as the run left it, so that nothing of it can be believed; bring that back, or start anew with "
          "--force");
    former.left = job.task->resume(former.document) ? Left::nothing : Left::something;
    if (former.left == Left::something && !as_written)
      throw InputError(fmt::format(
          "nothing tells that these partial results are as a run left them ({} is missing); start anew with --force",
          digest_file));
    keep_former(former.document, provenance);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: cannot be resumed: {}", file.string(), error.what()));
  } catch (const std::exception& error) {  // a key that is missing, a value of another type
    throw InputError(fmt::format("{}: cannot be resumed: not a results file of this program ({})",
                                 file.string(), error.what()));
  }
  return former;
}

/// Of a run that has nothing left to do.
int already_complete(const Job& job, const boost::json::value& document, const RunRequest& request)
{
  const std::filesystem::path& folder = request.folder;
  // The run may have been killed after its last result, before it had tidied up.
  const std::vector<const char*> names = result_names();
  remove_abandoned(folder, names);
  remove_abandoned(folder, std::array{digest_file});
  drop_previous(folder, names);
  drop_journal(folder);
  std::error_code ignored;
  std::filesystem::remove(folder / digest_file, ignored);
  say("{}: complete already\n", (folder / results_file).string());
  if (request.further && !std::filesystem::exists(folder / page_file, ignored))
    say("it has no {0}; `hauberk export {1} -o {1}.html` makes a page of it\n", page_file, folder.string());
  const bool missed = report_expectations(job.prepared->experiment, document);
  return missed || job.task->failed() ? exit_failed : exit_done;
}

[[noreturn]] void fail_with_partial_results(const std::string& reason, RunFolder& output)
{
  try {
    output.write();
  } catch (const ComputationError& error) {
    throw ComputationError(
        fmt::format("{}; and what was computed cannot be saved: {}", reason, error.what()));
  }
  throw ComputationError(fmt::format("{}; what was computed is in {}", reason, output.directory().string()));
}

/// Everything after the folder was prepared: from here on nothing is bad input. What is gathered and not yet
/// compared is no result.
void compute(Job& job, RunContext& context, RunFolder& output, const Gathering* gathering)
{
  const auto fail = [&](const std::string& reason) {
    context.progress.clear();
    if (gathering != nullptr) throw ComputationError(reason);
    fail_with_partial_results(reason, output);
  };
  try {
    if (gathering != nullptr) job.task->join_parts(context, gathering->folders);
    if (!interrupted()) job.task->run(context);
  } catch (const ComputationError& error) {
    fail(error.what());
  } catch (const InputError& error) {
    fail(error.what());
  }
}

/// The end of a run whose results are written: what came of it, on the terminal.
int conclude(const Job& job, RunFolder& output, const boost::json::object& document, double seconds)
{
  if (!interrupted()) output.done();
  say("{}\n\n{}", job.prepared->experiment.name, job.task->summary());
  say("{:.2f} s\n", seconds);
  const bool missed = !interrupted() && report_expectations(job.prepared->experiment, document);
  std::string names = results_file;
  for (const auto& [what, name] : document.at("files").as_object())
    names += ", " + std::string(name.as_string());
  say("results in {}: {}\n", output.directory().string(), names);
  if (interrupted()) {
    say("{}", interrupted_note);
    return exit_interrupted;
  }
  return missed || job.task->failed() ? exit_failed : exit_done;
}

}  // namespace

int run_experiment(Job& job, const RunRequest& request)
{
  const std::filesystem::path& folder = request.folder;
  Provenance origin = provenance(*job.prepared, request.threads, job.task->measures_time());
  origin.processors =
      request.gathering != nullptr ? request.gathering->processors : std::vector<std::string>();
  // A folder that cannot be made is told of when it is prepared.
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const FolderLock lock(folder, request.take_over);
  const Former former = request.resume ? resume(folder, job, origin) : Former{};
  if (former.left == Left::nothing) return already_complete(job, former.document, request);
  const std::vector<const char*> names = result_names();
  // Killed before its first results.json, a run leaves other files: --resume starts anew over them.
  prepare_output_directory(folder, request.force || request.resume, names);
  remove_abandoned(folder, std::array{digest_file});

  const bool resuming = former.left == Left::something;
  if (!resuming && request.gathering == nullptr) drop_journal(folder);
  Progress progress(Progress::detect(request.quiet));
  if (request.resume && request.gathering == nullptr)
    progress.note(resuming ? job.task->resume_note() : "nothing to resume: starting anew");
  const boost::json::object blank = blank_document(job, origin);
  boost::json::object document;  // as it was written last
  const auto note_peak_memory = [&origin] {
    origin.peak_memory_bytes = std::max(origin.peak_memory_bytes, peak_memory_bytes());
  };
  bool complete = false;
  RunFolder output(folder, names, resuming, progress, [&] {
    note_peak_memory();
    document = blank;
    document["provenance"] = provenance_json(origin);
    return result_content(job, folder, document, complete ? request.further : FurtherFiles());
  });
  RunContext context{request.threads,
                     progress,
                     folder,
                     resuming,
                     [&] { return identity(*job.prepared, origin); },
                     [&output] { output.write_sometimes(); },
                     [&output] { output.write_partial(); },
                     note_peak_memory};
  if (request.gathering != nullptr) {
    // What was found is in logs; results that were not compared must not look final.
    context.save = context.save_sometimes = [] {};
    context.memory = request.gathering->memory;
  }
  compute(job, context, output, request.gathering);
  progress.clear();
  if (request.gathering != nullptr) {
    request.gathering->check();
    if (interrupted()) {
      say("interrupted; the same command goes on\n");
      return exit_interrupted;
    }
  }
  complete = !interrupted();
  output.write();
  return conclude(job, output, document,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - request.begin).count());
}

}  // namespace hauberk::command
