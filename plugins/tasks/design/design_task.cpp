#include "tasks/design/design_task.hpp"

#include "design/design_problem.hpp"
#include "document/json_text.hpp"
#include "document/json_writer.hpp"
#include "equilibrium/rest.hpp"
#include "results/designed_experiment.hpp"
#include "run/interrupt.hpp"
#include "run/limit_tasks.hpp"
#include "run/limits_run.hpp"
#include "run/machine.hpp"
#include "run/nearest_node.hpp"
#include "run/plan_text.hpp"
#include "run/presets.hpp"
#include "run/run_folder.hpp"
#include "tasks/design/design_limits.hpp"
#include "tasks/design/design_section.hpp"
#include "tasks/design/design_spec.hpp"
#include "tasks/design/design_tables.hpp"
#include "tasks/design/start_logs.hpp"
#include "tasks/design/tapped_optimizer.hpp"
#include "tasks/limits/kept_limits.hpp"
#include "tasks/limits/limit_files.hpp"
#include "tasks/limits/limit_tables.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace hauberk {
namespace {

/// Iterates that violate constraints by more than this (L) are not offered as the best so far.
constexpr double acceptable_violation = 1e-6;

double initial_value(const Prepared& prepared, const DesignVariable& v)
{
  const auto& [element, parameter] = v.entries.front();
  return prepared.scene.elements[element].parameters[parameter];
}

bool ended_well(const std::string& status)
{
  return status != "failed" && status != "interrupted" && status != "infeasible";
}

class DesignTask final : public TaskRun {
 public:
  DesignTask(const Prepared& prepared, Diagnostics& diagnostics)
      : TaskRun(prepared),
        experiment_(prepared.experiment),
        spec_(design_spec(experiment_)),
        limits_(prepared, target_limits(spec_).tasks.size(), design_tasks(spec_, profile_tasks(experiment_)))
  {
    run_.scene = prepared.scene;
    for (const Problem& problem : design_solver_problems(experiment_.solver))
      diagnostics.problems.add(nearest_node(experiment_.resolved, problem.pointer), problem.message);
    if (!diagnostics.empty()) return;
    try {
      DesignProblem problem({prepared.scene, *experiment_.load_case, experiment_.solver.clearance,
                             prepared.settings, spec_, 1, [] { return true; }});
      if (const std::string impossible = problem.impossible_hole(); !impossible.empty())
        diagnostics.problems.add(nearest_node(experiment_.resolved, "/design/hole_clearance"), impossible);
      initial_scene_ = with_rest(problem.current().spec, problem.current().model, problem.current().rest);
    } catch (const InputError& error) {
      diagnostics.problems.add(nearest_node(experiment_.resolved, "/design"), error.what());
    } catch (const ComputationError& error) {  // not even the rest state can be computed
      diagnostics.problems.add(nearest_node(experiment_.resolved, "/design"), error.what());
    }
  }

  std::vector<LimitTask> limit_tasks() const override { return limits_.tasks(); }

  /// A target in a direction that links leave free can never be met.
  void check_plan(const Plan& plan, Diagnostics& diagnostics) const override
  {
    const std::size_t per = spec_.quantity == DesignQuantity::eta ? 2 : 1;
    const std::vector<std::size_t> first = target_limits(spec_).first;
    for (std::size_t k = 0; k < per * first.size(); ++k) {
      const auto& [task, bounded] = plan.bounded[first[k / per] + k % per];
      if (bounded == Boundedness::attained) continue;
      const std::string name =
          limit_name(experiment_.load_case->sense_name(task.direction, task.sense), task.direction);
      diagnostics.problems.add(
          nearest_node(experiment_.resolved, fmt::format("/design/targets/{}", k / per)),
          fmt::format("{} is {}: links set no limit that a design could change", name, to_string(bounded)));
    }
  }

  std::string check_line(const Plan& plan) const override
  {
    return fmt::format("{}, {} design variables", limits_check_line(plan, limits_.tasks().size()),
                       spec_.variables.size());
  }

  boost::json::object plan() const override
  {
    boost::json::array variables;
    for (const DesignVariable& v : spec_.variables)
      variables.push_back({{"name", v.name}, {"from", v.lower}, {"to", v.upper}});
    const auto search = [this](double last) {
      Schedule schedule = spec_.schedule;
      schedule.last = std::max(schedule.last, last);
      const std::vector<PlannedStage> stages =
          planned_stages(prepared_.model, prepared_.settings.contact, schedule);
      return boost::json::object{{"stages", stages.size()},
                                 {"last_activation_distance", stages.back().g_hat}};
    };
    const std::size_t searched = target_limits(spec_).tasks.size();
    return {{"variables", variables},      {"limits_per_evaluation", searched},
            {"starts", spec_.starts},      {"first_search", search(spec_.coarse_last)},
            {"final_search", search(0.0)}, {"limits_before_and_after", 2 * limits_.tasks().size()}};
  }

  /// The limits before and after, and from every start one evaluation of the searched ones.
  Work work(const Plan& plan) const override
  {
    const auto searched = static_cast<double>(target_limits(spec_).tasks.size());
    Work work = work_of(plan, plan.searches).times(2.0);
    const Work starts = work_of(plan, searched).times(spec_.starts);
    work.searches += starts.searches;
    work.evaluations += starts.evaluations;
    return work;
  }

  bool resume(const boost::json::value& results) override
  {
    const boost::json::value& design = results.at("design");
    const KeptLimits kept = kept_limits(results, experiment_, limits_.tasks());
    if (design.is_null() || !kept.complete) return false;
    const std::string status(design.at("status").as_string());
    if (status == "interrupted") return false;
    for (const std::optional<LimitResult>& limit : kept.limits) run_.limits.push_back(*limit);
    run_.design.emplace().status = status;
    return true;
  }

  std::string resume_note() const override { return "resuming: the search is repeated from its evaluations"; }

  void run(RunContext& context) override
  {
    context_ = &context;
    start_partial();
    DesignResult& design = *run_.design;
    // The profile's directions too, so that plots compare before and after everywhere.
    design.initial_limits = limits_.compute(context, limits_before, limits_.as_it_is(initial_scene_),
                                            [&](const std::vector<LimitResult>& so_far) {
                                              design.initial_limits = so_far;
                                              context.save_sometimes();
                                            });
    enter_initial();
    context.save();
    if (interrupted()) return;
    search();
    if (interrupted()) return;
    finish();
  }

  std::string why_whole() const override { return {}; }

  /// Limits of the initial design, and searches from starts, each with a log of its own.
  void run_part(RunContext& context, const Share& share) override
  {
    context_ = &context;
    limits_.compute_part(context, limits_before, limits_.as_it_is(initial_scene_), share);
    const std::string identity = context.identity(), processor = this_machine().processor;
    for (int start = 0; start < spec_.starts && !interrupted(); ++start) {
      if (!share.has(static_cast<std::size_t>(start))) continue;
      EvaluationLog log(claim_start_log(context.folder, start, identity, processor),
                        part_identity(identity, processor), true,
                        [&](const std::string& warning) { context.progress.warn(warning); });
      search(start, log, [&](const DesignProgress& p) {
        context.progress.design(p, spec_, false);
        return !interrupted();
      });
    }
    context.progress.clear();
  }

  /// Of every start the first evaluation is made once more and compared.
  void join_parts(RunContext& context, const std::vector<std::filesystem::path>& folders) override
  {
    context_ = &context;
    std::vector<StartLog> logs;
    for (int start = 0; start < spec_.starts && !interrupted(); ++start) {
      const std::vector<StartLog> of_start = logs_of_start(folders, start, context.identity());
      if (of_start.empty()) break;  // searched now, as all that follow
      logs.push_back(
          longest_of(of_start, [&](const std::string& warning) { context.progress.warn(warning); }));
      check_first(start, logs.back());
    }
    if (interrupted()) return;
    join_evaluations(logs, context.identity(), context.folder / journal_file);
    context.resumed = true;
  }

  void enter(boost::json::object& results) const override
  {
    enter_run(results, run_, macro_names(*experiment_.load_case));
  }

  std::vector<ResultFile> files(const std::filesystem::path& folder) const override
  {
    std::vector<ResultFile> out = limit_files(prepared_, run_);
    const bool finished = run_.design && run_.design->status != "interrupted";
    if (!run_.design || (!finished && run_.design->history.empty())) return out;
    const std::string written = write_json(in_folder(experiment_.expanded, experiment_, folder.string()));
    out.push_back({finished ? "designed" : "best_so_far", finished ? designed_file : best_so_far_file,
                   write_json(designed_experiment(written, run_.scene))});
    if (!finished) return out;
    if (const auto fabric = designed_fabric(written, run_.scene))
      out.push_back({"designed_fabric", designed_fabric_file, write_json(*fabric)});
    return out;
  }

  std::string summary() const override
  {
    std::string text = rest_remark(prepared_);
    if (run_.design) text += design_tables(*run_.design, spec_.starts, units());
    return text + limit_tables(experiment_, run_);
  }

  bool failed() const override
  {
    return !all_answered(run_.limits) ||
           (run_.design && (!ended_well(run_.design->status) || !all_answered(run_.design->initial_limits)));
  }

 private:
  /// Of the variables, as people read them.
  std::vector<std::string> units() const
  {
    std::vector<std::string> out;
    for (const DesignVariable& v : spec_.variables) {
      const auto& [element, parameter] = v.entries.front();
      const std::size_t type = prepared_.scene.elements[element].type;
      const std::string& unit = prepared_.scene.types[type].shape->parameters()[parameter].unit;
      out.push_back(unit == "length" ? experiment_.length_unit : unit == "degree" ? "degrees" : "");
    }
    return out;
  }

  static constexpr const char *limits_before = "limits before", *limits_after = "limits after";

  /// A search from one start, for its memory. What ends it early ends it again where it is asked for.
  void search(int start, EvaluationMemory& memory, const DesignObserver& observer)
  {
    const auto& section = *experiment_.section<ExperimentDesign>();
    const TappedOptimizer optimizer(*section.optimizer, section.max_iterations, [](const DesignPoint&) {});
    try {
      search_start(
          prepared_.scene, *experiment_.load_case, experiment_.solver.clearance, prepared_.settings, spec_,
          optimizer, context_->threads, start, observer, memory, [] { return !interrupted(); },
          limits_.report(*context_, spec_));
    } catch (const SearchInterrupted&) {
    } catch (const Interrupted&) {
    } catch (const InputError&) {
    } catch (const ComputationError&) {
    }
  }

  /// Throws ComputationError where the first evaluation of a log is not what it is here, though it should be.
  void check_first(int start, const StartLog& log)
  {
    FirstEvaluation first;
    search(start, first, [](const DesignProgress&) { return false; });
    if (begins_with(log, first.text())) return;
    if (log.processor == this_machine().processor)
      throw ComputationError(fmt::format(
          "{}: its first evaluation is not what it is here, though the processors are of one kind: a file or a "
          "memory is damaged; remove its folder and compute its part again",
          log.file.string()));
    context_->progress.warn(fmt::format(
        "warning: {}: its first evaluation is not what it is here: processors of several kinds round differently",
        log.file.string()));
  }

  /// A design result that is whole at any time, as partial results hold it.
  void start_partial()
  {
    run_.scene = initial_scene_;
    DesignResult& d = run_.design.emplace();
    d.quantity = spec_.quantity_name;
    d.status = "interrupted";
    d.message = "partial results: the run was not finished";
    d.objective = d.objective_initial = std::numeric_limits<double>::quiet_NaN();
    d.initial_scene = initial_scene_;
    for (const DesignVariable& v : spec_.variables) {
      const double x = initial_value(prepared_, v);
      d.variables.push_back({v.name, x, x, v.lower, v.upper, v.elements()});
    }
    for (const DesignTarget& t : spec_.targets) {
      DesignTargetResult r;
      r.direction_deg = t.direction_deg;
      r.target = t.value;
      r.weight = t.weight;
      r.aim = t.aim;
      d.targets.push_back(r);
    }
  }

  void enter_initial()
  {
    DesignResult& d = *run_.design;
    const auto values = target_values(spec_, d.initial_limits);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      d.targets[i].initial = values[i];
      const DesignTarget& t = spec_.targets[i];
      const double r = miss(t.aim, t.value, values[i].value_or(std::numeric_limits<double>::quiet_NaN()));
      sum += 0.5 * t.weight * r * r;
    }
    d.objective_initial = sum;
  }

  /// Called with every iterate and its design.
  bool observe(const DesignProgress& p)
  {
    // Objectives of coarse and final stages cannot be compared: the final search starts a new count.
    const bool begins = p.iterate->iteration == 0;
    if (begins && !fine_ && p.start <= start_) {
      fine_ = true;
      best_ = std::numeric_limits<double>::infinity();
      history_ = run_.design->history;
    } else if (begins) {
      history_.clear();
    }
    if (begins) first_ = history_.empty() ? 0 : history_.back().iteration + 1;
    start_ = p.start;
    // Objectives from other states cannot be compared with this one.
    if (!p.iterate->changed.empty()) best_ = std::numeric_limits<double>::infinity();
    context_->progress.design(p, spec_, fine_);
    history_.push_back(*p.iterate);
    history_.back().iteration += first_;
    keep_best(p);
    context_->save_sometimes();
    return !interrupted();
  }

  /// Enters the iterate into the partial results if it is the best of its search.
  void keep_best(const DesignProgress& p)
  {
    const double violation = p.iterate->constraint_violation / prepared_.scene.length;
    if (point_ == nullptr || !(p.iterate->objective < best_) || violation > acceptable_violation) return;
    best_ = p.iterate->objective;
    run_.scene = with_rest(point_->spec, point_->model, point_->rest);
    DesignResult& d = *run_.design;
    for (std::size_t v = 0; v < d.variables.size(); ++v) d.variables[v].final = point_->x[v];
    for (std::size_t i = 0; i < d.targets.size() && i < point_->values.size(); ++i)
      d.targets[i].provisional = point_->values[i];
    d.history = history_;
    d.start = p.start;
    d.iterations = history_.back().iteration;
  }

  void search()
  {
    const auto& section = *experiment_.section<ExperimentDesign>();
    const TappedOptimizer optimizer(*section.optimizer, section.max_iterations,
                                    [this](const DesignPoint& p) { point_ = &p; });
    EvaluationLog log(context_->folder / journal_file, context_->identity(), context_->resumed,
                      [this](const std::string& warning) { context_->progress.warn(warning); });
    if (context_->resumed)
      context_->progress.note(fmt::format("resuming: {} evaluations of the search are known", log.known()));
    Designed designed;
    try {
      designed = run_design(
          prepared_.scene, *experiment_.load_case, experiment_.solver.clearance, prepared_.settings, spec_,
          optimizer, context_->threads,
          [&](const DesignProgress& p) {
            run_.design->evaluations = log.closest_points();
            return observe(p);
          },
          &log, [] { return !interrupted(); }, limits_.report(*context_, spec_));
    } catch (const SearchInterrupted&) {
      return stopped(log);
    } catch (const Interrupted&) {
      return stopped(log);
    }
    context_->progress.clear();
    const DesignResult partial = *run_.design;
    DesignResult& d = run_.design.emplace(std::move(designed.result));
    run_.scene = std::move(designed.scene);
    run_.scene.length = prepared_.scene.length;
    d.initial_scene = initial_scene_;
    d.initial_limits = partial.initial_limits;
    d.objective_initial = partial.objective_initial;
    for (std::size_t i = 0; i < d.targets.size(); ++i) d.targets[i].initial = partial.targets[i].initial;
    for (std::size_t v = 0; v < d.variables.size(); ++v)
      d.variables[v].initial = partial.variables[v].initial;
    if (interrupted()) {
      d.status = "interrupted";
      d.message = partial.message;
    }
    d.objective = std::numeric_limits<double>::quiet_NaN();  // until limits are recomputed
    context_->save();
  }

  /// The best so far is in `run_`.
  void stopped(const EvaluationLog& log)
  {
    context_->progress.clear();
    run_.design->evaluations = log.closest_points();
  }

  /// Limits of the design from its rest state, with all stages and starts.
  void finish()
  {
    DesignResult& d = *run_.design;
    const std::string status = d.status, message = d.message;
    d.status = "interrupted";
    d.message = "the search was done (" + status + "), its limits were not yet recomputed";
    // With rest_clearance = clearance the search closes gaps.
    const ReportedScene after = limits_.with_open_gaps(run_.scene);
    run_.scene = after.scene;
    if (const std::vector<LimitResult>* known = limits_.reported(after)) {
      run_.limits = *known;
    } else {
      run_.limits =
          limits_.compute(*context_, limits_after, after, [&](const std::vector<LimitResult>& so_far) {
            run_.limits = so_far;
            context_->save_sometimes();
          });
    }
    run_.profiles = profiles(run_.limits, *experiment_.load_case);
    std::stable_sort(
        run_.profiles.begin(), run_.profiles.end(), [](const ProfilePoint& a, const ProfilePoint& b) {
          return a.direction_deg < b.direction_deg;  // limits of targets come first, but a profile is a curve
        });
    if (interrupted()) return;
    d.status = status;
    d.message = message;
    finish_design(d, spec_, d.initial_limits, run_.limits);
  }

  const Experiment& experiment_;
  DesignSpec spec_;
  DesignLimits limits_;
  SceneSpec initial_scene_;  ///< relaxed to the design's rest clearance
  RunResult run_;
  RunContext* context_ = nullptr;  ///< while it runs

  const DesignPoint* point_ = nullptr;  ///< of the iterate that is being observed
  std::vector<DesignIterate> history_;  ///< of the search that runs, with that of the one it continues
  int first_ = 0;                       ///< number of its first iterate
  int start_ = -1;
  bool fine_ = false;  ///< the best design is being continued with final stages
  double best_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::unique_ptr<TaskRun> prepare_design(const Prepared& prepared, Diagnostics& diagnostics)
{
  return std::make_unique<DesignTask>(prepared, diagnostics);
}

}  // namespace hauberk
