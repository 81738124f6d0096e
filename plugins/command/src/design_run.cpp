#include "design_run.hpp"
#include "evaluation_log.hpp"
#include "interrupt.hpp"
#include "limits_run.hpp"
#include "presets.hpp"
#include "tapped_optimizer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace hauberk::command {
namespace {

/// Iterates that violate constraints by more than this (L) are not offered as the best so far.
constexpr double acceptable_violation = 1e-6;

double initial_value(const Loaded& loaded, const DesignVariable& v)
{
  const auto& [element, parameter] = v.entries.front();
  return loaded.scene.elements[static_cast<std::size_t>(element)]
      .parameters[static_cast<std::size_t>(parameter)];
}

class DesignRun {
 public:
  DesignRun(const Loaded& loaded, unsigned threads, bool go_on, Progress& progress, Output& output,
            RunResult& run)
      : loaded_(loaded),
        experiment_(loaded.experiment),
        threads_(threads),
        go_on_(go_on),
        progress_(progress),
        output_(output),
        run_(run),
        spec_(*loaded.design)
  {
  }

  void go()
  {
    start_partial();
    DesignResult& design = *run_.design;
    // The profile's directions too, so that plots compare before and after everywhere.
    design.initial_limits = limits("limits before", loaded_.design_scene, loaded_.tasks,
                                   [&](const std::vector<LimitResult>& so_far) {
                                     design.initial_limits = so_far;
                                     output_.write_sometimes(run_);
                                   });
    enter_initial();
    output_.write_partial(run_);
    if (interrupted()) return;
    search();
    if (interrupted()) return;
    finish();
  }

 private:
  std::vector<LimitResult> limits(const std::string& label, const SceneSpec& scene,
                                  std::vector<LimitTask> tasks, const LimitsSink& sink)
  {
    const Model model = make_model(scene, *experiment_.load_case, experiment_.solver.clearance);
    // Of this scene: a design may have made tubes thinner.
    LimitSettings settings = limit_settings(experiment_.solver, scene, experiment_.length_unit);
    settings.start = strained_start_;
    LimitsJob job{&model, &scene, std::move(tasks), settings, experiment_.load_case_plugin, threads_,
                  label,  {}};
    std::vector<LimitResult> out = run_limits(job, progress_, sink);
    progress_.clear();
    return out;
  }

  /// A design result that is whole at any time, as partial results hold it.
  void start_partial()
  {
    run_.scene = loaded_.design_scene;
    DesignResult& d = run_.design.emplace();
    d.quantity = spec_.quantity_name;
    d.status = "interrupted";
    d.message = "partial results: the run was not finished";
    d.objective = d.objective_initial = std::numeric_limits<double>::quiet_NaN();
    d.initial_scene = loaded_.design_scene;
    for (const DesignVariable& v : spec_.variables) {
      const double x = initial_value(loaded_, v);
      d.variables.push_back({v.name, x, x, v.lower, v.upper, v.elements()});
    }
    for (const DesignTarget& t : spec_.targets) {
      DesignTargetResult r;
      r.direction_deg = t.direction_deg;
      r.target = t.value;
      r.weight = t.weight;
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
      const double r = values[i].value_or(std::numeric_limits<double>::quiet_NaN()) - spec_.targets[i].value;
      sum += 0.5 * spec_.targets[i].weight * r * r;
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
    progress_.design(p, spec_, fine_);
    history_.push_back(*p.iterate);
    history_.back().iteration += first_;
    keep_best(p);
    output_.write_sometimes(run_);
    return !interrupted();
  }

  /// Enters the iterate into the partial results if it is the best of its search.
  void keep_best(const DesignProgress& p)
  {
    const double violation = p.iterate->constraint_violation / loaded_.scene.length;
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
    const TappedOptimizer optimizer(*experiment_.design->optimizer, experiment_.design->max_iterations,
                                    [this](const DesignPoint& p) { point_ = &p; });
    EvaluationLog log(output_.directory() / evaluation_log_file, output_.identity(), go_on_,
                      [this](const std::string& warning) { progress_.warn(warning); });
    if (go_on_) progress_.note(fmt::format("resuming: {} evaluations of the search are known", log.known()));
    Designed designed;
    try {
      designed = run_design(
          loaded_.scene, *experiment_.load_case, experiment_.solver.clearance, loaded_.settings, spec_,
          optimizer, threads_,
          [&](const DesignProgress& p) {
            run_.design->evaluations = log.closest_points();
            return observe(p);
          },
          &log);
    } catch (const SearchInterrupted&) {
      progress_.clear();
      run_.design->evaluations = log.closest_points();
      return;  // the best so far is in `run_`
    }
    progress_.clear();
    const DesignResult partial = *run_.design;
    DesignResult& d = run_.design.emplace(std::move(designed.result));
    run_.scene = std::move(designed.scene);
    run_.scene.length = loaded_.scene.length;
    d.initial_scene = loaded_.design_scene;
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
    output_.write_partial(run_);
  }

  /// Limits of the design from its rest state, with all stages and starts.
  void finish()
  {
    DesignResult& d = *run_.design;
    const std::string status = d.status, message = d.message;
    d.status = "interrupted";
    d.message = "the search was done (" + status + "), its limits were not yet recomputed";
    // Opens gaps that touch, as for any other scene: with rest_clearance = clearance the search closes them.
    PreparedScene prepared = prepare_rest(run_.scene, *experiment_.load_case, experiment_.solver.clearance);
    run_.scene = std::move(prepared.scene);
    strained_start_ = std::move(prepared.start);
    run_.limits =
        limits("limits after", run_.scene, loaded_.tasks, [&](const std::vector<LimitResult>& so_far) {
          run_.limits = so_far;
          output_.write_sometimes(run_);
        });
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

  const Loaded& loaded_;
  const Experiment& experiment_;
  unsigned threads_;
  bool go_on_;
  Progress& progress_;
  Output& output_;
  RunResult& run_;
  DesignSpec spec_;
  std::optional<State> strained_start_;  ///< where the final limits start, if not at rest

  const DesignPoint* point_ = nullptr;  ///< of the iterate that is being observed
  std::vector<DesignIterate> history_;  ///< of the search that runs, with that of the one it continues
  int first_ = 0;                       ///< number of its first iterate
  int start_ = -1;
  bool fine_ = false;  ///< the best design is being continued with final stages
  double best_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void run_design_task(const Loaded& loaded, unsigned threads, bool go_on, Progress& progress, Output& output,
                     RunResult& run)
{
  DesignRun(loaded, threads, go_on, progress, output, run).go();
}

}  // namespace hauberk::command
