#include "dispatch.hpp"
#include "options.hpp"
#include "report/report.hpp"
#include "results/designed_experiment.hpp"
#include "results/document.hpp"
#include "results/timings.hpp"
#include "say.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;

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
  return {.name = "report",
          .form = "RESULT... -o DIR [--force] [--recheck FOLDER]",
          .line = "a table and a page of plots of many results",
          .synopsis = "report RESULT... -o DIR [options]",
          .summary =
              "Writes report.md, report.csv and report.svg from results of designs and limits: how far "
              "designs are from their targets, what they cost, every direction, and a page of polar "
              "plots. A folder stands for the results.json in it.",
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
  entries.reserve(options.positionals().size());
  for (const std::string& result : options.positionals()) {
    const std::string file = file_of(result).string();
    entries.push_back(read_report_entry(read_result(file), file));
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
  const std::vector<NamedContent> files = report_content(entries);
  prepare_output_directory(folder, options.has("force"), report_names);
  write_files_atomically(folder, files, report_names);
  say("{} results in {}: {}, {}, {}\n", entries.size(), folder.string(), report_text_file, report_table_file,
      report_picture_file);
  return exit_done;
}

}  // namespace hauberk::command
