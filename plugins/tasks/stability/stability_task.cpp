#include "tasks/stability/stability_task.hpp"

#include "document/json_values.hpp"
#include "results/direction_json.hpp"
#include "run/limit_tasks.hpp"
#include "tasks/stability/stability_loading.hpp"
#include "tasks/stability/stability_run.hpp"
#include "tasks/stability/stability_section.hpp"
#include "tasks/stability/stability_summary.hpp"
#include "tasks/variants/grid.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

namespace json = boost::json;

bool same_case(const json::object& entry, const StabilityMap& map, const StabilityCase& c)
{
  return text_of(entry.at("family")) == map.families[c.family].name &&
         text_of(entry.at("member")) == map.families[c.family].labels[c.member] &&
         text_of(entry.at("method")) == map.methods[c.method] &&
         (c.sense.empty() ? entry.at("sense").is_null()
                          : text_of(entry.at("sense")) == c.sense && entered_direction(entry) == c.direction);
}

void take_case(const json::object& entry, StabilityCase& c)
{
  for (const Outcome outcome : outcomes) {
    if (to_string(outcome) == text_of(entry.at("outcome"))) c.outcome = outcome;
  }
  if (c.outcome == Outcome::interrupted) return;
  c.status = text_of(entry.at("status"));
  c.message = text_of(entry.at("message"));
  c.contact = text_of(entry.at("contact"));
  c.value = number_or_none(entry.at("value"));
  c.slack = number_or_zero(entry.at("slack"));
  c.checked = entry.at("checked").as_bool();
  c.check = text_of(entry.at("check"));
  c.min_gap = number_or_none(entry.at("min_gap"));
  c.error_estimate = number_or_none(entry.at("error_estimate"));
  c.force_balance = number_or_none(entry.at("force_balance"));
  c.iterations = static_cast<int>(number_or_zero(entry.at("iterations")));
  c.evaluations = static_cast<long>(number_or_zero(entry.at("evaluations")));
  if (const json::value* seconds = entry.if_contains("seconds")) c.seconds = number_or_zero(*seconds);
}

class StabilityTask final : public TaskRun {
 public:
  StabilityTask(const Prepared& prepared, Diagnostics& diagnostics)
      : TaskRun(prepared), items_(load_stability(stability(), prepared.lookup, diagnostics))
  {
    if (diagnostics.empty()) map_ = empty_map(stability(), items_);
  }

  std::string check_line(const Plan& /*plan*/) const override
  {
    return fmt::format("{} families, {} methods, {} scenes to solve", stability().families.size(),
                       stability().methods.size(), items_.size());
  }

  json::object plan() const override
  {
    return {{"families", map_.families.size()},
            {"methods", map_.methods.size()},
            {"scenes", items_.size()},
            {"cases", map_.cases.size()}};
  }

  /// Every scene as the experiment itself.
  Work work(const Plan& plan) const override
  {
    return work_of(plan, plan.searches).times(static_cast<double>(items_.size()));
  }

  /// The experiment is the same, so its cases are the same and in the same order.
  bool resume(const json::value& results) override
  {
    take_rows(results.at("stability").at("cases").as_array(), map_.cases, "cases",
              [this](const json::value& value, StabilityCase& c) {
                const json::object& entry = value.as_object();
                if (!same_case(entry, map_, c)) return false;
                take_case(entry, c);
                return true;
              });
    return std::none_of(map_.cases.begin(), map_.cases.end(),
                        [](const StabilityCase& c) { return c.outcome == Outcome::interrupted; });
  }

  std::string resume_note() const override { return "resuming: finished cases are kept"; }

  void run(RunContext& context) override { run_stability(items_, context, map_); }

  std::string why_whole() const override { return {}; }

  void run_part(RunContext& context, const Share& share) override
  {
    std::vector<VariantReading> readings;
    readings.reserve(items_.size());
    for (const StabilityItem& item : items_) readings.push_back(item.reading);
    run_rows_of_part(context, "stability", readings, share);
  }

  void enter(json::object& results) const override { results["stability"] = stability_json(map_); }

  std::vector<ResultFile> files(const std::filesystem::path& /*folder*/) const override
  {
    const auto& [cases, picture] = stability_file_names;
    return {{"stability", cases, stability_csv(map_)},
            {"picture", picture, stability_svg(map_, prepared_.experiment.name)}};
  }

  std::string summary() const override { return stability_summary(map_); }

  /// Cases that fail are what it is for; an `expect` about their counts may fail the run.
  bool failed() const override { return false; }

 private:
  const ExperimentStability& stability() const
  {
    return *prepared_.experiment.section<ExperimentStability>();
  }

  std::vector<StabilityItem> items_;  ///< by family, member, method
  StabilityMap map_;
};

}  // namespace

std::unique_ptr<TaskRun> prepare_stability(const Prepared& prepared, Diagnostics& diagnostics)
{
  return std::make_unique<StabilityTask>(prepared, diagnostics);
}

}  // namespace hauberk
