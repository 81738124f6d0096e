#include "tasks/limits/limits_task.hpp"

#include "run/limit_tasks.hpp"
#include "run/limits_run.hpp"
#include "tasks/limits/kept_limits.hpp"
#include "tasks/limits/limit_files.hpp"
#include "tasks/limits/limit_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

class LimitsTask final : public TaskRun {
 public:
  explicit LimitsTask(const Prepared& prepared)
      : TaskRun(prepared), tasks_(profile_tasks(prepared.experiment))
  {
    run_.scene = prepared.scene;
  }

  LimitsTask(const Prepared& prepared, std::vector<LimitResult> solved) : LimitsTask(prepared)
  {
    take(std::move(solved));
  }

  std::vector<LimitTask> limit_tasks() const override { return tasks_; }

  std::string check_line(const Plan& plan) const override { return limits_check_line(plan, tasks_.size()); }

  bool resume(const boost::json::value& results) override
  {
    kept_ = kept_limits(results, prepared_.experiment, tasks_);
    if (kept_.complete) {
      for (const std::optional<LimitResult>& limit : kept_.limits) run_.limits.push_back(*limit);
    }
    return kept_.complete;
  }

  std::string resume_note() const override { return "resuming: finished limits are kept"; }

  void run(RunContext& context) override
  {
    take(run_limits(job(context), context.progress, [&](const std::vector<LimitResult>& so_far) {
      take(so_far);
      context.save_sometimes();
    }));
  }

  std::string why_whole() const override { return {}; }

  void run_part(RunContext& context, const Share& share) override
  {
    run_searches(job(context), context.progress, share);
  }

  void enter(boost::json::object& results) const override
  {
    enter_run(results, run_, macro_names(*prepared_.experiment.load_case));
    boost::json::array& limits = results["limits"].as_array();
    for (std::size_t k = 0; k < kept_.entries.size() && k < limits.size(); ++k) {
      // A limit that was there may have learnt from one that was not: then it is a new one.
      if (!run_.limits[k].resumed) continue;
      const boost::json::value confidence = limits[k].at("confidence");
      limits[k] = kept_.entries[k];
      limits[k].as_object()["confidence"] = confidence;  // others may confirm it
    }
  }

  std::vector<ResultFile> files(const std::filesystem::path& /*folder*/) const override
  {
    return limit_files(prepared_, run_);
  }

  std::string summary() const override
  {
    return rest_remark(prepared_) + limit_tables(prepared_.experiment, run_);
  }

  bool failed() const override { return !all_answered(run_.limits); }

 private:
  LimitsJob job(const RunContext& context) const
  {
    return {&prepared_.model, &prepared_.scene, tasks_,       prepared_.settings, load_case(),
            context.threads,  "limits",         kept_.limits, context.memory};
  }

  const std::string& load_case() const { return prepared_.experiment.load_case_plugin; }

  void take(std::vector<LimitResult> limits)
  {
    run_.limits = std::move(limits);
    run_.profiles = profiles(run_.limits, *prepared_.experiment.load_case);
    run_.boundary =
        boundary_of(prepared_.experiment, prepared_.settings, prepared_.model.length, run_.limits);
  }

  std::vector<LimitTask> tasks_;
  KeptLimits kept_;
  RunResult run_;
};

}  // namespace

std::unique_ptr<TaskRun> prepare_limits(const Prepared& prepared, Diagnostics& /*diagnostics*/)
{
  return std::make_unique<LimitsTask>(prepared);
}

std::unique_ptr<TaskRun> solved_limits(const Prepared& prepared, std::vector<LimitResult> limits)
{
  return std::make_unique<LimitsTask>(prepared, std::move(limits));
}

}  // namespace hauberk
