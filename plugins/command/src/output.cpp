#include "output.hpp"

#include <hauberk/experiment/json_writer.hpp>
#include <hauberk/version.hpp>

#include <cholmod.h>
#include <fmt/format.h>
#include <boost/version.hpp>

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
  p.seed = loaded.experiment.seed;
  p.threads = static_cast<int>(threads);
  return p;
}

Output::Output(std::filesystem::path directory, const Loaded& loaded, unsigned threads)
    : directory_(std::move(directory)),
      experiment_json_(write_json(loaded.experiment.resolved)),
      provenance_(provenance(loaded, threads))
{
  const Experiment& e = loaded.experiment;
  names_.macro.clear();
  for (const MacroInfo& macro : e.load_case->macros()) names_.macro.push_back(macro.name);
  labels_.title = e.name;
  labels_.subtitle = fmt::format("{}, measure {}, clearance {:g} {}", e.load_case_plugin,
                                 e.load_case->measure(), e.solver.clearance, e.length_unit);
  std::tie(labels_.positive, labels_.negative) = e.load_case->sense_names();
  labels_.unit = unit_of(loaded);
}

void Output::write(const RunResult& run)
{
  names_.files = result_files(run);
  document_ = results_document(run, experiment_json_, provenance_, names_);
  boost::json::array& limits = document_["limits"].as_array();
  for (std::size_t k = 0; k < kept_.size() && k < limits.size(); ++k) {
    if (!kept_[k].is_null()) limits[k] = kept_[k];
  }
  write_results(directory_, document_, run, experiment_json_, names_, labels_);
  last_ = std::chrono::steady_clock::now();
}

void Output::write(const RunResult& run, const StabilityMap& map)
{
  names_.files = stability_files();
  document_ = results_document(run, experiment_json_, provenance_, names_);
  document_["stability"] = stability_json(map);
  write_stability(directory_, document_, map, labels_.title);
  last_ = std::chrono::steady_clock::now();
}

void Output::write(const RunResult& run, const TransitionResult& transition)
{
  names_.files = transition_files();
  document_ = results_document(run, experiment_json_, provenance_, names_);
  document_["transition"] = transition_json(transition);
  write_transition(directory_, document_, transition, labels_.title);
  last_ = std::chrono::steady_clock::now();
}

bool Output::is_time() const { return std::chrono::steady_clock::now() - last_ >= write_interval; }

void Output::write_sometimes(const RunResult& run)
{
  if (is_time()) write(run);
}

void Output::write_sometimes(const RunResult& run, const StabilityMap& map)
{
  if (is_time()) write(run, map);
}

}  // namespace hauberk::command
