#include "output.hpp"
#include "evaluation_log.hpp"
#include "machine.hpp"
#include "memory.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/json_writer.hpp>
#include <hauberk/results/atomic_file.hpp>
#include <hauberk/version.hpp>

#include <cholmod.h>
#include <fmt/format.h>
#include <boost/json/serialize.hpp>
#include <boost/version.hpp>

#include <algorithm>
#include <cstdlib>

namespace hauberk::command {
namespace {

/// Between partial results; a kill loses at most this much.
constexpr std::chrono::seconds write_interval{2};

std::string unit_of(const Loaded& loaded)
{
  switch (loaded.experiment.load_case->value_length_power()) {
    case 0:
      return "strain";
    case -1:
      return "1/" + loaded.experiment.length_unit;
    default:
      return "value";
  }
}

/// Writes into a new folder for temporary files and returns its name; empty where that fails, too.
std::string rescue(const std::vector<NamedContent>& files)
{
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) return "";
  std::string name = (folder / "hauberk-results-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return "";
  try {
    write_files_atomically(name, files);
    return name;
  } catch (const ComputationError&) {
    std::filesystem::remove(name, error);
    return "";
  }
}

}  // namespace

Provenance provenance(const Loaded& loaded, unsigned threads)
{
  Provenance p;
  p.version = version;
  p.build_type = build_type;
  p.compiler = HAUBERK_COMPILER " (" __VERSION__ "), " HAUBERK_STDLIB;
  p.libraries = {
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Boost",
       fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"CHOLMOD",
       fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)}};
  p.plugins = loaded.plugins;
  p.weaves = loaded.weaves;
  p.files = loaded.files;
  p.seed = loaded.experiment.seed;
  p.threads = static_cast<int>(threads);
  if (loaded.chart) p.machine = this_machine();
  return p;
}

Output::Output(std::filesystem::path directory, const Loaded& loaded, unsigned threads, bool resuming,
               Progress& progress)
    : directory_(std::move(directory)),
      progress_(progress),
      own_(resuming),
      experiment_json_(write_json(loaded.experiment.resolved)),
      experiment_here_(
          write_json(in_folder(loaded.experiment.expanded, loaded.experiment, directory_.string()))),
      provenance_(provenance(loaded, threads))
{
  const Experiment& e = loaded.experiment;
  names_.macro.clear();
  for (const MacroInfo& macro : e.load_case->macros()) names_.macro.push_back(macro.name);
  labels_.title = e.name;
  labels_.subtitle =
      fmt::format("{}, measure {}, clearance {:g} {}", e.load_case_plugin,
                  e.directions.empty() ? e.load_case->measure() : e.load_case->measure(e.directions.front()),
                  e.solver.clearance, e.length_unit);
  std::tie(labels_.positive, labels_.negative) = e.load_case->sense_names();
  labels_.unit = unit_of(loaded);
}

void Output::note_peak_memory()
{
  provenance_.peak_memory_bytes = std::max(provenance_.peak_memory_bytes, peak_memory_bytes());
}

void Output::keep_load_average(const std::optional<double>& load)
{
  if (provenance_.machine && load)
    provenance_.machine->load_average = std::max(provenance_.machine->load_average.value_or(*load), *load);
}

boost::json::object Output::document(const RunResult& run)
{
  note_peak_memory();
  return results_document(run, experiment_json_, provenance_, names_);
}

Output::Files Output::content(const RunResult& run)
{
  names_.files = result_files(run);
  document_ = document(run);
  boost::json::array& limits = document_["limits"].as_array();
  for (std::size_t k = 0; k < kept_.size() && k < limits.size(); ++k) {
    // A limit that was there may have learnt from one that was not: then it is a new one.
    if (run.limits[k].resumed) limits[k] = kept_[k];
  }
  return results_content(document_, run, experiment_here_, names_, labels_);
}

Output::Files Output::content(const RunResult& run, const StabilityMap& map)
{
  names_.files = stability_files();
  document_ = document(run);
  document_["stability"] = stability_json(map);
  return stability_content(document_, map, labels_.title);
}

Output::Files Output::content(const RunResult& run, const SweepTable& table)
{
  names_.files = sweep_files();
  document_ = document(run);
  document_["sweep"] = sweep_json(table);
  return sweep_content(document_, table, labels_);
}

Output::Files Output::content(const RunResult& run, const PrecisionChart& chart)
{
  names_.files = chart_files();
  document_ = document(run);
  document_["chart"] = chart_json(chart);
  return chart_content(document_, chart, labels_.title);
}

Output::Files Output::content(const RunResult& run, const TransitionResult& transition)
{
  names_.files = transition_files();
  document_ = document(run);
  document_["transition"] = transition_json(transition);
  return transition_content(document_, transition, labels_.title);
}

void Output::replace(const Files& files)
{
  last_ = std::chrono::steady_clock::now();  // also when it fails: a full disk is not asked at every iterate
  write_files_atomically(directory_, files, own_ ? FormerResults::replaced : FormerResults::kept);
  own_ = true;
}

void Output::write_or_rescue(const Files& files)
try {
  replace(files);
} catch (const ComputationError& error) {
  const std::string elsewhere = rescue(files);
  if (elsewhere.empty())
    throw ComputationError(
        fmt::format("{}; make room, then go on with --resume from what was written before", error.what()));
  throw ComputationError(
      fmt::format("{}; the results are in {}: make room and move them, or go on with --resume from what was "
                  "written before",
                  error.what(), elsewhere));
}

void Output::try_writing(const Files& files)
try {
  replace(files);
  warned_.clear();
} catch (const ComputationError& error) {
  if (warned_ == error.what()) return;
  warned_ = error.what();
  progress_.warn(fmt::format("warning: {}; going on, and trying again", error.what()));
}

void Output::write(const RunResult& run) { write_or_rescue(content(run)); }

void Output::write(const RunResult& run, const StabilityMap& map) { write_or_rescue(content(run, map)); }

void Output::write(const RunResult& run, const SweepTable& table) { write_or_rescue(content(run, table)); }

void Output::write(const RunResult& run, const PrecisionChart& chart)
{
  write_or_rescue(content(run, chart));
}

void Output::write(const RunResult& run, const TransitionResult& transition)
{
  write_or_rescue(content(run, transition));
}

void Output::write_partial(const RunResult& run) { try_writing(content(run)); }

void Output::done()
{
  drop_previous(directory_);
  drop_evaluations(directory_);
}

std::string Output::identity() const
{
  boost::json::object provenance = document_.at("provenance").as_object();
  for (const char* varies : {"threads", "peak_memory_bytes"}) provenance.erase(varies);
  return boost::json::serialize(
      boost::json::object{{"experiment", document_.at("experiment")}, {"provenance", provenance}});
}

void drop_evaluations(const std::filesystem::path& directory)
{
  std::error_code ignored;
  std::filesystem::remove(directory / evaluation_log_file, ignored);
}

bool Output::is_time() const { return std::chrono::steady_clock::now() - last_ >= write_interval; }

void Output::write_sometimes(const RunResult& run)
{
  if (is_time()) try_writing(content(run));
}

void Output::write_sometimes(const RunResult& run, const StabilityMap& map)
{
  if (is_time()) try_writing(content(run, map));
}

void Output::write_sometimes(const RunResult& run, const SweepTable& table)
{
  if (is_time()) try_writing(content(run, table));
}

void Output::write_sometimes(const RunResult& run, const PrecisionChart& chart)
{
  if (is_time()) try_writing(content(run, chart));
}

}  // namespace hauberk::command
