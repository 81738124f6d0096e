#include <hauberk/results/boundary.hpp>
#include <hauberk/results/csv.hpp>
#include <hauberk/results/designed_experiment.hpp>
#include <hauberk/results/json_text.hpp>
#include <hauberk/results/write_results.hpp>

namespace hauberk {
namespace {

/// A boundary of three unknowns is a surface.
bool has_surface(const RunResult& run)
{
  return run.boundary && run.limits.front().direction.components().size() == 3;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> result_files(const RunResult& run)
{
  if (run.boundary && !has_surface(run)) return {{"limits", limits_file}};
  if (run.boundary)
    return {{"limits", limits_file}, {"boundary", boundary_file}, {"picture", boundary_picture_file}};
  std::vector<std::pair<std::string, std::string>> out{{"limits", limits_file}, {"profile", profile_file}};
  if (run.design) out.emplace_back("designed", designed_file);
  return out;
}

std::vector<NamedContent> results_content(const boost::json::object& document, const RunResult& run,
                                          const std::string& experiment_json, const ResultNames& names,
                                          const PlotLabels& labels)
{
  std::vector<NamedContent> files{{limits_file, limits_csv(run.limits, names.macro)}};
  if (has_surface(run)) {
    files.push_back({boundary_file, boundary_ply(run, labels.unit, names.macro)});
    files.push_back({boundary_picture_file, boundary_svg(run, labels, names.macro)});
  } else if (!run.boundary) {
    files.push_back({profile_file, polar_svg(run, labels)});
  }
  if (run.design)
    files.push_back({designed_file, write_json(designed_experiment(experiment_json, run.scene))});
  files.push_back({results_file, write_json(document)});
  return files;
}

std::vector<std::pair<std::string, std::string>> stability_files()
{
  return {{"stability", stability_file}, {"picture", stability_picture_file}};
}

std::vector<NamedContent> stability_content(const boost::json::object& document, const StabilityMap& map,
                                            const std::string& title)
{
  return {{stability_file, stability_csv(map)},
          {stability_picture_file, stability_svg(map, title)},
          {results_file, write_json(document)}};
}

std::vector<std::pair<std::string, std::string>> transition_files()
{
  return {{"transition", transition_file},
          {"minima", transition_minima_file},
          {"picture", transition_picture_file}};
}

std::vector<NamedContent> transition_content(const boost::json::object& document,
                                             const TransitionResult& result, const std::string& title)
{
  return {{transition_file, transition_csv(result)},
          {transition_minima_file, transition_minima_csv(result)},
          {transition_picture_file, transition_svg(result, title)},
          {results_file, write_json(document)}};
}

std::vector<std::pair<std::string, std::string>> sweep_files()
{
  return {{"sweep", sweep_file}, {"picture", sweep_picture_file}};
}

std::vector<NamedContent> sweep_content(const boost::json::object& document, const SweepTable& table,
                                        const PlotLabels& labels)
{
  return {{sweep_file, sweep_csv(table)},
          {sweep_picture_file, sweep_svg(table, labels.title, labels.subtitle)},
          {results_file, write_json(document)}};
}

std::vector<std::pair<std::string, std::string>> chart_files()
{
  return {{"chart", chart_file}, {"picture", chart_picture_file}, {"work_picture", chart_work_picture_file}};
}

std::vector<NamedContent> chart_content(const boost::json::object& document, const PrecisionChart& chart,
                                        const std::string& title)
{
  return {{chart_file, chart_csv(chart)},
          {chart_picture_file, chart_svg(chart, PrecisionCost::seconds, title)},
          {chart_work_picture_file, chart_svg(chart, PrecisionCost::evaluations, title)},
          {results_file, write_json(document)}};
}

}  // namespace hauberk
