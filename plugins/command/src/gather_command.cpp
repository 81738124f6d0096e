#include "dispatch.hpp"
#include "page_files.hpp"
#include "part_run.hpp"
#include "run/interrupt.hpp"
#include "run/weave_library.hpp"
#include "say.hpp"
#include "shell_words.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;

/// Which of the parts are there, and on what they were computed.
struct PartsThere {
  std::vector<fs::path> folders;
  std::vector<std::size_t> missing;  ///< numbers from 1
  std::vector<std::string> processors;
};

void note_processor(const std::string& name, std::vector<std::string>& processors)
{
  if (std::find(processors.begin(), processors.end(), name) == processors.end()) processors.push_back(name);
}

PartsThere read_parts(const fs::path& folder, const Division& division, SearchLogs& logs)
{
  PartsThere out;
  for (std::size_t k = 0; k < division.count; ++k) {
    const fs::path part = part_path(folder, {k, division.count});
    bool complete = false;
    for (const fs::path& file : logs_in(part, searches_name)) {
      const std::optional<SearchLogs::Contents> contents = logs.read(file);
      if (!contents) continue;
      complete = complete || contents->complete;
      note_processor(contents->origin.processor, out.processors);
    }
    if (!complete) out.missing.push_back(k + 1);
    out.folders.push_back(part);
  }
  for (const fs::path& file : logs_in(folder / parts_folder / gathered_folder, searches_name)) {
    if (const std::optional<SearchLogs::Contents> contents = logs.read(file))
      note_processor(contents->origin.processor, out.processors);
  }
  return out;
}

std::string texts(const SearchLogs::Conflict& c)
{
  return c.other.empty() ? fmt::format("'{}' of {} is not what it is here", c.search, c.file)
                         : fmt::format("'{}' of {} is not that of {}", c.search, c.file, c.other);
}

/// Throws where two outcomes of one search differ though they should not; warns where processors do.
void check_conflicts(const SearchLogs& logs, std::size_t& told)
{
  const std::vector<SearchLogs::Conflict> conflicts = logs.conflicts();
  for (const SearchLogs::Conflict& c : conflicts) {
    if (!c.one_processor) continue;
    throw ComputationError(fmt::format(
        "the search {}, though the processors are of one kind: a file or a memory is damaged; remove the file "
        "and compute its part again",
        texts(c)));
  }
  for (; told < conflicts.size(); ++told)
    say_error("hauberk: warning: the search {}: processors of several kinds round differently\n",
              texts(conflicts[told]));
}

Job open_division(const Division& division, const std::string& experiment,
                  const std::vector<std::string>& by_hand)
{
  std::vector<fs::path> folders(by_hand.begin(), by_hand.end());
  // What was noted elsewhere, or has moved since, is not missed here: a plugin that is not there is.
  for (const std::string& noted : division.libraries) {
    std::error_code unknown;
    if (fs::is_directory(noted, unknown)) folders.emplace_back(noted);
  }
  return prepare_job(registry_of(folders),
                     {experiment, read_text_file(experiment), division.set, weave_lookup(experiment)});
}

/// The command that computes a part, as its folder of parts knows it.
std::string part_command(const Division& division, const fs::path& folder)
{
  std::string out = "hauberk run " + shell_word(division.experiment);
  for (const std::string& set : division.set) out += " --set " + shell_word(set);
  for (const std::string& library : division.libraries) out += " --plugin-path " + shell_word(library);
  return out + fmt::format(" --part K/{} -o {}", division.count, shell_word(folder.string()));
}

}  // namespace

Description gather_description()
{
  return {
      .name = "gather",
      .form = "DIR [--missing] [--force] [--threads N]",
      .line = "join the parts of a divided run",
      .synopsis = "gather DIR [options]",
      .summary =
          "Joins what `run --part` has left in DIR: names the parts that are missing, does one search of each "
          "log once more and compares, lets limits learn from each other, and writes the results that `run` "
          "would have written, byte for byte on the same build and kind of processor. Parts of several kinds "
          "are named in the results, below `provenance`. It can be interrupted and started again.",
      .arguments = {{.name = "DIR", .offer = Offer::folders}},
      .options = {
          {.name = "experiment",
           .takes = Takes::text,
           .value = "FILE",
           .help = "the experiment, where it is no longer in the place that the parts have noted",
           .offer = Offer::experiments},
          {.name = "missing",
           .help = "print the parts that are missing, as Slurm lists them (`1-3,7`), and do nothing else"},
          {.name = "force", .help = "replace results that the folder holds"},
          {.name = "take-over",
           .takes = Takes::text,
           .value = "HOST:PID",
           .help = "take the folder from this run, which is no more (see `run`)"},
          {.name = "threads",
           .takes = Takes::integer,
           .value = "N",
           .help = "threads to use; default: all processors that the process may use"},
          {.name = "html", .help = "leave also `report.html` (see `run`)"},
          {.name = "quiet", .help = "show no progress"},
          plugin_path_option()}};
}

int gather_command(const std::vector<std::string>& words)
{
  catch_interrupts();
  RunRequest request;
  Options options(gather_description());
  options.parse(words);
  request.threads = threads_of(options);
  request.folder = options.positional();
  request.quiet = options.has("quiet");
  if (options.has("take-over")) request.take_over = options.get<std::string>("take-over");
  const Division division = read_division(request.folder);
  const std::string experiment =
      options.has("experiment") ? options.get<std::string>("experiment") : division.experiment;
  Job job = [&] {
    const NothingToLose scope;
    return open_division(division, experiment, options.list("plugin-path"));
  }();
  refuse_whole(job);
  SearchLogs logs(identity_of(job), [](const std::string& warning) { say_error("hauberk: {}\n", warning); });
  const PartsThere there = read_parts(request.folder, division, logs);
  const std::string missing = part_list(there.missing);
  if (options.has("missing")) {
    say("{}{}", missing, missing.empty() ? "" : "\n");
    return exit_done;
  }
  if (!there.missing.empty())
    throw ComputationError(fmt::format("{}: {} of {} parts missing: {}; compute each with `{}`",
                                       request.folder.string(), there.missing.size(), division.count, missing,
                                       part_command(division, request.folder)));
  std::size_t told = 0;
  check_conflicts(logs, told);
  warn_of_plugins(*job.prepared);
  logs.check_one_of_each();
  const fs::path own = request.folder / parts_folder / gathered_folder;
  const LogOrigin origin = log_origin(gathered_folder);
  logs.write_to(own, searches_name, origin);
  Gathering gathering{&logs, there.folders, there.processors, [&] { check_conflicts(logs, told); }};
  note_processor(origin.processor, gathering.processors);
  if (gathering.processors.size() < 2) gathering.processors.clear();
  request.gathering = &gathering;
  if (options.has("html")) request.further = page_of_run(job, installed_page_parts());
  // Results of an interrupted one are gone on from.
  request.force = options.has("force");
  request.resume = !request.force;
  const int code = run_experiment(job, request);
  if (const auto [checked, all] = logs.checked(); checked > 0)
    say("{} parts with {} searches{}; one of {} of {} logs was done once more and is the same\n",
        division.count, logs.known(),
        logs.done_again() > 0 ? fmt::format(", {} of them of no use", logs.done_again()) : "", checked, all);
  return code;
}

}  // namespace hauberk::command
