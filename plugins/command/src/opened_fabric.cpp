#include "opened_fabric.hpp"

#include "document/json_place.hpp"
#include "document/json_text.hpp"
#include "document/read_file.hpp"
#include "page_files.hpp"
#include "run/weave_library.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <filesystem>

namespace hauberk::command {
namespace {

namespace fs = std::filesystem;

/// Results, of a sweep those of the row that is asked for.
boost::json::value row_of(boost::json::value results, const Options& options, const std::string& file)
{
  const detail::JsonPlace document(results, file);
  const auto sweep = document.find("sweep");
  if (!options.has("row")) {
    if (sweep && options.has("state") && options.get<std::string>("state") != "rest")
      throw InputError(
          fmt::format("--state {}: {} are results of a sweep, whose rows have limits; give --row K",
                      options.get<std::string>("state"), file));
    return results;
  }
  const int number = options.get<int>("row");
  if (!sweep)
    throw InputError(fmt::format("--row {}: {} are no results of a sweep; leave it out", number, file));
  const std::vector<detail::JsonPlace> rows = sweep->at("rows").items();
  if (number < 0 || static_cast<std::size_t>(number) >= rows.size())
    throw InputError(fmt::format("--row {}: {} has {} rows, 0 to {}", number, file, rows.size(),
                                 static_cast<int>(rows.size()) - 1));
  const detail::JsonPlace row = rows[number];
  const auto result = row.find("result");
  if (!result)
    throw InputError(fmt::format("--row {}: it has no result: {}, {}", number, row.at("status").text(),
                                 row.at("message").text()));
  boost::json::value out = result->value();
  // Rows are of the program that their sweep is of.
  if (const auto provenance = document.find("provenance"))
    out.as_object()["provenance"] = provenance->value();
  return out;
}

}  // namespace

Opened open_fabric(const Options& options)
{
  std::string file = options.positional();
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) file = (fs::path(file) / results_file).string();
  const std::string state = options.has("state") ? options.get<std::string>("state") : "rest";
  const std::string text = read_whole_file(file, largest_results);
  const bool is_results = text.find("\"hauberk-results/") != std::string::npos;
  if (!is_results) {
    if (options.has("row")) throw InputError("--row: an experiment has none; run it, and give its results");
    if (state != "rest")
      throw InputError(fmt::format("--state {}: an experiment has only its rest; run it, and give its {}",
                                   state, results_file));
    Job job = prepare_job(open_registry(options), {file, text, options.list("set"), weave_lookup(file)});
    const Prepared& prepared = *job.prepared;
    exporting::Fabric fabric =
        exporting::fabric_of(prepared.scene, prepared.experiment.name, prepared.experiment.length_unit);
    return {file, nullptr, std::move(job), std::move(fabric)};
  }
  if (!options.list("set").empty()) throw InputError("--set: results are as they are; give an experiment");
  boost::json::value results = row_of(parse_json(text, file), options, file);
  Job job = job_of_results(open_registry(options), results, file);
  exporting::Fabric fabric = exporting::fabric_in_results(results, file, job.prepared->scene, state);
  return {file, std::move(results), std::move(job), std::move(fabric)};
}

}  // namespace hauberk::command
