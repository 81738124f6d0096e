#include "dispatch.hpp"
#include "experiment_options.hpp"
#include "options.hpp"
#include "page_files.hpp"
#include "report/report.hpp"
#include "results/designed_experiment.hpp"
#include "results/document.hpp"
#include "results/timings.hpp"
#include "say.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;

/// A document and the file that it was read from.
struct Shown {
  std::string file;
  boost::json::value results;
};

/// A folder stands for the results in it.
fs::path file_of(const std::string& result)
{
  std::error_code unknown;  // then reading tells
  return fs::is_directory(result, unknown) ? fs::path(result) / results_file : fs::path(result);
}

/// Reads a file; where that fails, also says what would do.
boost::json::value read_result(const fs::path& file)
try {
  return read_timed_results(file, say_times_lost);
} catch (const InputError& error) {
  throw InputError(
      fmt::format("{}; give the {} that `hauberk run` wrote, or its folder", error.what(), results_file));
}

/// The fabrics of all results on one page; none where it cannot be made, which a word tells, as of results
/// that cannot be shown.
std::optional<NamedContent> page_of(const std::vector<Shown>& results)
{
  try {
    const exporting::PageParts parts = installed_page_parts();
    const std::shared_ptr<const Registry> registry = registry_of({});
    std::vector<boost::json::object> entries;
    for (const Shown& one : results) {
      try {
        const Job job = job_of_results(registry, one.results, one.file);
        entries.push_back(exporting::page_entry(one.results, one.file, job.prepared->scene, {}));
      } catch (const InputError& error) {
        say_error("hauberk: warning: {} is not on the page: {}\n", one.file, error.what());
      }
    }
    if (!entries.empty()) return NamedContent{page_file, page(std::move(entries), parts)};
  } catch (const InputError& error) {
    say_error("hauberk: warning: no {}: {}\n", page_file, error.what());
  }
  return std::nullopt;
}

/// Enters what the folder beside the results holds; false where there is none.
bool recheck(ReportEntry& entry, const std::string& folder)
{
  const fs::path file = fs::path(entry.file).parent_path() / folder / results_file;
  std::error_code unknown;
  if (!entry.design || !fs::exists(file, unknown)) return false;
  enter_recheck(entry, read_result(file), file.string());
  return true;
}

std::string required_folder(const Options& options, const char* name)
{
  if (!options.has(name) || options.get<std::string>(name).empty())
    throw UsageError(fmt::format("--{}: expected a folder", name), options.usage());
  return options.get<std::string>(name);
}

}  // namespace

Description report_description()
{
  return {
      .name = "report",
      .form = "RESULT... -o DIR [--force] [--recheck FOLDER]",
      .line = "a table and a page of plots of many results",
      .synopsis = "report RESULT... -o DIR [options]",
      .summary =
          "Writes report.md, report.csv and report.svg from results of designs and limits: how far "
          "designs are from their targets, what they cost, every direction, and a page of polar "
          "plots; and report.html, which shows their fabrics, to turn by hand, where the viewer of pages was "
          "built. A folder stands for the results.json in it.",
      .arguments = {{.name = "RESULT", .offer = Offer::results, .several = true}},
      .options = {{.name = "output",
                   .letter = 'o',
                   .takes = Takes::text,
                   .value = "DIR",
                   .help = "folder for the report",
                   .offer = Offer::folders},
                  {.name = "force", .help = "replace a report that the folder holds"},
                  {.name = "recheck",
                   .takes = Takes::text,
                   .value = "FOLDER",
                   .help = "in the folder of each design's results, a folder with limits of its "
                           "designed.json computed apart; designs without it are shown without"}}};
}

int report_command(const std::vector<std::string>& words)
{
  Options options(report_description());
  options.parse(words);
  const fs::path folder = required_folder(options, "output");
  std::vector<ReportEntry> entries;
  std::vector<Shown> shown;
  for (const std::string& result : options.positionals()) {
    const std::string file = file_of(result).string();
    shown.push_back({file, read_result(file)});
    entries.push_back(read_report_entry(shown.back().results, file));
  }
  if (options.has("recheck")) {
    const std::string beside = required_folder(options, "recheck");
    std::size_t found = 0;
    for (ReportEntry& entry : entries) found += recheck(entry, beside) ? 1 : 0;
    if (found == 0)
      throw InputError(
          fmt::format("--recheck {}: no design has a folder of that name with {} beside its results; run its "
                      "{} into it, or leave the option out",
                      beside, results_file, designed_file));
  }
  std::vector<NamedContent> files = report_content(entries);
  if (std::optional<NamedContent> page = page_of(shown)) files.push_back(std::move(*page));
  prepare_output_directory(folder, options.has("force"), report_names);
  write_files_atomically(folder, files, report_names);
  std::string names;
  for (const char* name : report_names) {
    const auto same = [name](const NamedContent& file) { return file.name == name; };
    if (std::any_of(files.begin(), files.end(), same))
      names += (names.empty() ? "" : ", ") + std::string(name);
  }
  say("{} results in {}: {}\n", entries.size(), folder.string(), names);
  return exit_done;
}

}  // namespace hauberk::command
