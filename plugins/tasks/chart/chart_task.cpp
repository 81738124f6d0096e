#include "tasks/chart/chart_task.hpp"

#include "document/json_values.hpp"
#include "run/limit_tasks.hpp"
#include "run/machine.hpp"
#include "tasks/chart/chart_loading.hpp"
#include "tasks/chart/chart_run.hpp"
#include "tasks/chart/chart_section.hpp"
#include "tasks/chart/chart_summary.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

namespace json = boost::json;

/// Times of two machines do not belong into one picture.
void check_machine(const json::value& then, const Machine& now)
{
  const std::string processor = text_of(then.at("processor"));
  const int processors = then.at("processors").to_number<int>();
  if (processor != now.processor || processors != now.processors)
    throw InputError(fmt::format(
        "it was timed on another machine ({} of '{}'), this has {} of '{}'; start anew with --force",
        processors, processor, now.processors, now.processor));
}

class ChartTask final : public TaskRun {
 public:
  ChartTask(const Prepared& prepared, Diagnostics& diagnostics)
      : TaskRun(prepared), loaded_(load_chart(prepared.experiment, prepared.lookup, diagnostics))
  {
    if (diagnostics.empty()) chart_ = empty_chart(chart(), loaded_);
  }

  std::string check_line(const Plan& /*plan*/) const override
  {
    return fmt::format("{} scenes, {} methods, {} points of {} runs", chart().scenes.size(),
                       chart().methods.size(), loaded_.items.size() * chart().threads.size(),
                       chart().repeats);
  }

  json::object plan() const override
  {
    const auto references = std::count_if(chart_.scenes.begin(), chart_.scenes.end(),
                                          [](const PrecisionScene& scene) { return scene.has_reference; });
    return {{"scenes", chart_.scenes.size()},
            {"methods", chart_.methods.size()},
            {"references", references},
            {"points", chart_.points.size()},
            {"runs_per_point", chart_.repeats}};
  }

  /// Every run of a point as the experiment itself.
  Work work(const Plan& plan) const override
  {
    const double runs = static_cast<double>(chart_.points.size()) * chart_.repeats;
    return work_of(plan, plan.searches).times(runs);
  }

  bool measures_time() const override { return true; }

  bool resume(const json::value& results) override
  {
    check_machine(results.at("provenance").at("machine"), this_machine());
    if (!take_chart(results.at("chart"), chart_)) throw InputError("its points are others");
    return std::none_of(chart_.points.begin(), chart_.points.end(),
                        [](const PrecisionPoint& p) { return p.status == RowStatus::interrupted; });
  }

  std::string resume_note() const override { return "resuming: finished runs are kept"; }

  std::string why_whole() const override { return "it measures times, which other work would change"; }

  void run(RunContext& context) override { run_chart(loaded_, context, chart_); }

  void enter(json::object& results) const override { results["chart"] = chart_json(chart_); }

  std::vector<ResultFile> files(const std::filesystem::path& /*folder*/) const override
  {
    const auto& [points, times, work] = chart_file_names;
    const std::string& title = prepared_.experiment.name;
    return {{"chart", points, chart_csv(chart_)},
            {"picture", times, chart_svg(chart_, PrecisionCost::seconds, title)},
            {"work_picture", work, chart_svg(chart_, PrecisionCost::evaluations, title)}};
  }

  std::string summary() const override { return chart_summary(chart_); }

  /// Points that fail are what it shows; a reference that fails, and runs that differ, fail the run.
  bool failed() const override { return any_failed(chart_); }

 private:
  const ExperimentChart& chart() const { return *prepared_.experiment.section<ExperimentChart>(); }

  LoadedChart loaded_;
  PrecisionChart chart_;
};

}  // namespace

std::unique_ptr<TaskRun> prepare_chart(const Prepared& prepared, Diagnostics& diagnostics)
{
  return std::make_unique<ChartTask>(prepared, diagnostics);
}

}  // namespace hauberk
