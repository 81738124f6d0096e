#include "tasks/sweep/sweep_task.hpp"

#include "run/labels.hpp"
#include "run/limit_tasks.hpp"
#include "tasks/sweep/sweep_run.hpp"
#include "tasks/sweep/sweep_section.hpp"
#include "tasks/variants/grid.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

class SweepTask final : public TaskRun {
 public:
  SweepTask(const Prepared& prepared, Diagnostics& diagnostics)
      : TaskRun(prepared), table_(empty_table(*prepared.experiment.section<ExperimentSweep>()))
  {
    const Experiment& e = prepared.experiment;
    const auto& sweep = *e.section<ExperimentSweep>();
    readings_.reserve(sweep.row_count());
    for (std::size_t row = 0; row < sweep.row_count(); ++row)
      readings_.push_back(read_sweep_row(sweep, row, e.name, prepared.lookup, diagnostics));
  }

  std::string check_line(const Plan& /*plan*/) const override
  {
    const auto refused = std::count_if(readings_.begin(), readings_.end(),
                                       [](const VariantReading& row) { return !row.experiment; });
    return fmt::format("{} rows of {} limits{}", readings_.size(), limit_tasks().size(),
                       refused > 0 ? fmt::format(" ({} refused as input)", refused) : "");
  }

  boost::json::object plan() const override
  {
    boost::json::array axes;
    for (const SweepTable::Axis& axis : table_.axes) axes.emplace_back(axis.name);
    const auto refused = std::count_if(readings_.begin(), readings_.end(),
                                       [](const VariantReading& row) { return !row.experiment; });
    return {{"axes", axes},
            {"rows", readings_.size()},
            {"refused_as_input", refused},
            {"limits_per_row", limit_tasks().size()}};
  }

  /// Every row as the experiment itself.
  Work work(const Plan& plan) const override
  {
    const auto rows = std::count_if(readings_.begin(), readings_.end(),
                                    [](const VariantReading& row) { return row.experiment.has_value(); });
    return work_of(plan, plan.searches).times(static_cast<double>(rows));
  }

  /// Rows of the same experiment are the same and in the same order.
  bool resume(const boost::json::value& results) override
  {
    take_rows(
        results.at("sweep").at("rows").as_array(), table_.rows, "rows",
        [this](const boost::json::value& entry, SweepRow& row) { return take_row(entry, table_, row); });
    return std::none_of(table_.rows.begin(), table_.rows.end(),
                        [](const SweepRow& row) { return row.status == RowStatus::interrupted; });
  }

  std::string resume_note() const override { return "resuming: finished rows are kept"; }

  void run(RunContext& context) override
  {
    run_sweep(*prepared_.experiment.load_case, readings_, context, table_);
  }

  std::string why_whole() const override { return {}; }

  void run_part(RunContext& context, const Share& share) override
  {
    run_rows_of_part(context, "sweep", readings_, share);
  }

  void enter(boost::json::object& results) const override { results["sweep"] = sweep_json(table_); }

  std::vector<ResultFile> files(const std::filesystem::path& /*folder*/) const override
  {
    const auto& [rows, picture] = sweep_file_names;
    std::vector<std::string> varied;
    for (const SweepAxis& axis : prepared_.experiment.section<ExperimentSweep>()->axes)
      for (const SweepPlace& place : axis.places) varied.push_back(place.pointer);
    const PlotLabels labels = plot_labels(prepared_.experiment, varied);
    return {{"sweep", rows, sweep_csv(table_)},
            {"picture", picture, sweep_svg(table_, labels.title, labels.subtitle)}};
  }

  std::string summary() const override { return sweep_summary(table_); }

  /// Rows that are bad input are answers.
  bool failed() const override { return any_failed(table_); }

 private:
  std::vector<VariantReading> readings_;  ///< by row
  SweepTable table_;
};

}  // namespace

std::unique_ptr<TaskRun> prepare_sweep(const Prepared& prepared, Diagnostics& diagnostics)
{
  return std::make_unique<SweepTask>(prepared, diagnostics);
}

}  // namespace hauberk
