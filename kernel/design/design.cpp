#include "design/design.hpp"

#include "design/design_problem.hpp"
#include "model/links.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace hauberk {
namespace {

double seconds_since(std::chrono::steady_clock::time_point t0)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
}

/// Records every iterate and passes it on.
class Recorder final : public OptimizerObserver {
 public:
  /// Iterates are counted from `first`.
  Recorder(DesignProblem& problem, const DesignSpec& design, int start, int first,
           const DesignObserver& observer)
      : problem_(problem),
        design_(design),
        tasks_(target_limits(design).tasks),
        start_(start),
        first_(first),
        observer_(observer),
        t0_(std::chrono::steady_clock::now())
  {
  }

  bool on_iterate(const OptimizerIterate& it) override
  {
    const DesignPoint& p = problem_.current();
    DesignIterate d;
    d.iteration = first_ + it.iteration;
    d.objective = it.value;
    d.step = it.step;
    d.optimality = it.optimality;
    d.constraint_violation = it.constraint_violation * p.model.length;
    d.min_gap = problem_.rest_distance();
    d.links_kept = links_kept(p.model, p.rest);
    d.seconds = seconds_since(t0_);
    d.variables = p.x;
    d.values = p.values;
    const auto senses = p.model.load->sense_names();
    for (const int k : p.changed) {
      const LimitTask& task = tasks_[k];
      d.changed.push_back(fmt::format("{}, {}", task.direction.text(),
                                      task.sense == Sense::positive ? senses.first : senses.second));
    }
    history.push_back(d);
    if (!observer_({start_, design_.starts, &history.back()})) interrupted = true;
    targets_met = it.constraint_violation <= negligible_violation && meets_targets(design_, p.values);
    return !interrupted && !targets_met;
  }

  std::vector<DesignIterate> history;
  bool interrupted = false, targets_met = false;

 private:
  DesignProblem& problem_;
  const DesignSpec& design_;
  std::vector<LimitTask> tasks_;
  int start_, first_;
  const DesignObserver& observer_;
  std::chrono::steady_clock::time_point t0_;
};

/// Starting design of a run: the scene's parameters moved at random, relative to the width of the bounds.
std::vector<double> random_move(const DesignSpec& design, int start)
{
  std::mt19937_64 rng(design.seed * 1000003U + static_cast<std::uint64_t>(start));
  std::vector<double> d;
  for (const DesignVariable& v : design.variables) {
    // Sum of uniforms: the same on every standard library.
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(rng() >> 11U) * 0x1.0p-53;
    d.push_back(design.perturbation * (v.upper - v.lower) * sum);
  }
  return d;
}

}  // namespace

std::vector<int> DesignVariable::elements() const
{
  std::vector<int> out;
  for (const auto& [element, parameter] : entries) out.push_back(element);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

TargetLimits target_limits(const DesignSpec& design)
{
  TargetLimits limits;
  for (const DesignTarget& target : design.targets) {
    const Direction direction = Direction::at_degrees(target.direction_deg);
    const auto known = std::find_if(limits.first.begin(), limits.first.end(), [&](std::size_t k) {
      return on_one_line(limits.tasks[k].direction, direction);
    });
    if (known != limits.first.end()) {
      limits.first.push_back(*known);
      continue;
    }
    limits.first.push_back(limits.tasks.size());
    if (design.quantity != DesignQuantity::negative) limits.tasks.push_back({direction, Sense::positive});
    if (design.quantity != DesignQuantity::positive) limits.tasks.push_back({direction, Sense::negative});
  }
  return limits;
}

namespace {

/// The part of a target within which a search counts it as met.
double share_of_search(Aim aim, double tolerance) { return aim == Aim::reach ? tolerance : met_share(aim); }

}  // namespace

bool meets_targets(const DesignSpec& design, const std::vector<double>& values)
{
  if (!design.tolerance || values.size() != design.targets.size()) return false;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const DesignTarget& t = design.targets[k];
    if (!is_within(share_of_search(t.aim, *design.tolerance), t.aim, t.value, values[k])) return false;
  }
  return true;
}

std::vector<std::optional<double>> target_values(const DesignSpec& design,
                                                 const std::vector<LimitResult>& limits)
{
  std::vector<std::optional<double>> out;
  const std::vector<std::size_t> first = target_limits(design).first;
  const auto locked = [&limits](std::size_t i) -> std::optional<double> {
    return limits[i].status == LimitStatus::locked ? limits[i].value : std::nullopt;
  };
  for (std::size_t i = 0; i < design.targets.size(); ++i) {
    if (design.quantity == DesignQuantity::eta) {
      const auto s = locked(first[i]), c = locked(first[i] + 1);
      out.push_back(s && c && 1.0 + *c > 0.0 ? std::optional((*s - *c) / (1.0 + *c)) : std::nullopt);
    } else {
      out.push_back(locked(first[i]));
    }
  }
  return out;
}

bool exceeds_targets(const DesignSpec& design, const std::vector<LimitResult>& limits)
{
  if (!design.tolerance) return false;
  const double along = design.quantity == DesignQuantity::negative ? -1.0 : 1.0;
  const std::vector<std::optional<double>> values = target_values(design, limits);
  for (std::size_t k = 0; k < design.targets.size(); ++k) {
    const DesignTarget& t = design.targets[k];
    if (values[k] && along * (*values[k] - t.value) > 0.0 &&
        !is_within(share_of_search(t.aim, *design.tolerance), t.aim, t.value, *values[k]))
      return true;
  }
  return false;
}

namespace {

/// One search and what came of it.
struct SearchOutcome {
  OptimizerResult found;
  std::vector<DesignIterate> history;
  bool interrupted = false;
};

SearchOutcome search(DesignProblem& problem, const DesignSpec& design, const Optimizer& optimizer,
                     std::span<const double> x0, int start, int first, const DesignObserver& observer)
{
  Recorder recorder(problem, design, start, first, observer);
  SearchOutcome s;
  s.found = optimizer.minimize(problem, x0, recorder);
  s.history = std::move(recorder.history);
  s.interrupted = recorder.interrupted;
  // The best point may not be the last accepted one.
  if (!s.history.empty() && problem.evaluate(s.found.x, false).ok) problem.accept(s.found.x);
  if (s.interrupted || s.history.empty()) return s;
  if (recorder.targets_met && meets_targets(design, problem.current().values)) {
    s.found.status = "targets_met";
    s.found.message = "every target is met to within design.tolerance, limits not yet recomputed";
  } else if (problem.settle()) {
    s.found.message +=
        "; the result is an earlier iterate: states that rest does not lead to made later ones look better";
  }
  s.found.x = problem.current().x;
  s.found.value = problem.current().objective;
  return s;
}

/// Searches that go on because a thorough look at what the last one ended with found other states.
constexpr int most_continuations = 3;

/// The search with the final stages. Where it ends without having met its targets, its design is looked at as
/// thoroughly as reported limits are; where that finds states further on, the search was after other values
/// than its own, and goes on from there.
SearchOutcome search_to_the_end(DesignProblem& problem, const DesignSpec& design, const Optimizer& optimizer,
                                std::span<const double> x0, int start, const DesignObserver& observer)
{
  SearchOutcome s = search(problem, design, optimizer, x0, start, 0, observer);
  for (int continuations = 0;; ++continuations) {
    if (s.interrupted || s.history.empty() || s.found.status == "targets_met") return s;
    if (!problem.confirm() || s.found.status == "iteration_limit") break;
    if (continuations == most_continuations) {
      s.found.message += "; where it ended, states were found once more that lead further";
      break;
    }
    const DesignIterate before = s.history.back();
    SearchOutcome next =
        search(problem, design, optimizer, problem.current().x, start, before.iteration + 1, observer);
    if (next.history.empty()) break;
    for (DesignIterate& it : next.history) it.seconds += before.seconds;
    next.history.insert(next.history.begin(), s.history.begin(), s.history.end());
    next.found.iterations += s.found.iterations + 1;
    s = std::move(next);
  }
  if (problem.take_best_confirmed()) {
    s.found.message +=
        "; the result is an earlier iterate: with all searches that limits have it is nearer to the targets";
  }
  s.found.x = problem.current().x;
  s.found.value = problem.current().objective;
  return s;
}

void enter(DesignResult& out, DesignProblem& problem, const DesignSpec& design, const SearchOutcome& s)
{
  const DesignPoint& p = problem.current();
  out.status = s.interrupted ? "interrupted" : s.found.status;
  out.message = s.found.message;
  std::vector<double> room(problem.constraint_count());
  problem.constraints(s.found.x, room, {});
  const double missing = room.empty() ? 0.0 : -*std::min_element(room.begin(), room.end()) * p.model.length;
  if (out.status == "infeasible")
    out.message += fmt::format("; the design misses a clearance by {:.3g} {}", missing, p.spec.length_unit);
  out.objective = s.found.value;
  const std::vector<double> initial = problem.scene_variables();
  for (std::size_t v = 0; v < design.variables.size(); ++v) {
    const DesignVariable& d = design.variables[v];
    out.variables.push_back({d.name, initial[v], s.found.x[v], d.lower, d.upper, d.elements()});
  }
  for (std::size_t i = 0; i < design.targets.size(); ++i) {
    DesignTargetResult t;
    t.direction_deg = design.targets[i].direction_deg;
    t.target = design.targets[i].value;
    t.weight = design.targets[i].weight;
    t.aim = design.targets[i].aim;
    if (i < p.values.size()) t.provisional = p.values[i];
    out.targets.push_back(t);
  }
}

/// A search from one start, and the problem that it leaves at its best design.
struct StartSearch {
  std::unique_ptr<DesignProblem> problem;
  SceneSpec initial_scene;  ///< as the search found it
  SearchOutcome outcome;
};

StartSearch search_from(const SceneSpec& scene, const LoadCase& load, double clearance,
                        const LimitSettings& limits, const DesignSpec& design, const Optimizer& optimizer,
                        unsigned threads, int start, const DesignObserver& observer, EvaluationMemory* memory,
                        const KeepGoing& keep_going, const LimitsReport& report)
{
  SceneSpec frozen = scene;
  frozen.length = characteristic_length(scene);
  Schedule coarse = design.schedule;
  coarse.last = std::max(coarse.last, design.coarse_last);
  coarse.ends_at_noise = true;
  StartSearch out;
  out.problem = std::make_unique<DesignProblem>(
      DesignScene{frozen, load, clearance, limits, design, threads, keep_going, report},
      static_cast<std::uint64_t>(start));
  out.initial_scene = with_relaxed_rest(out.problem->current());
  out.problem->set_memory(memory);
  out.problem->set_schedule(coarse, Look::quick);
  const std::vector<double> x0 = out.problem->feasible_towards(random_move(design, start));
  out.outcome = search(*out.problem, design, optimizer, x0, start, 0, observer);
  return out;
}

}  // namespace

bool search_start(const SceneSpec& scene, const LoadCase& load, double clearance, const LimitSettings& limits,
                  const DesignSpec& design, const Optimizer& optimizer, unsigned threads, int start,
                  const DesignObserver& observer, EvaluationMemory& memory, const KeepGoing& keep_going,
                  const LimitsReport& report)
{
  return !search_from(scene, load, clearance, limits, design, optimizer, threads, start, observer, &memory,
                      keep_going, report)
              .outcome.interrupted;
}

Designed run_design(const SceneSpec& scene, const LoadCase& load, double clearance,
                    const LimitSettings& limits, const DesignSpec& design, const Optimizer& optimizer,
                    unsigned threads, const DesignObserver& observer, EvaluationMemory* memory,
                    const KeepGoing& keep_going, const LimitsReport& report)
{
  const auto t0 = std::chrono::steady_clock::now();
  Designed out;
  std::unique_ptr<DesignProblem> best_problem;
  SearchOutcome best;
  std::string failure;
  bool interrupted = false;
  for (int start = 0; start < design.starts && !interrupted; ++start) {
    auto [problem, initial_scene, s] = search_from(scene, load, clearance, limits, design, optimizer, threads,
                                                   start, observer, memory, keep_going, report);
    if (start == 0) out.result.initial_scene = std::move(initial_scene);
    out.result.evaluations += problem->evaluations();
    interrupted = s.interrupted;
    if (s.history.empty()) {
      failure = s.found.message;
      continue;
    }
    out.result.starts.emplace_back(start, s.found.value);
    if (best_problem && !(s.found.value < best.found.value)) continue;
    best = std::move(s);
    best_problem = std::move(problem);
    out.result.start = start;
  }
  if (!best_problem) throw ComputationError("no design could be evaluated: " + failure);
  out.result.history = best.history;
  out.result.iterations = best.found.iterations;
  if (!interrupted) {
    const long before = best_problem->evaluations();
    best_problem->set_schedule(design.schedule, Look::quick_then_whole);
    const SearchOutcome fine =
        search_to_the_end(*best_problem, design, optimizer, best.found.x, out.result.start, observer);
    out.result.evaluations += best_problem->evaluations() - before;
    if (!fine.history.empty()) {
      out.result.iterations += fine.found.iterations;
      for (DesignIterate it : fine.history) {
        it.iteration += best.found.iterations + 1;
        it.seconds += best.history.back().seconds;
        out.result.history.push_back(it);
      }
      best = fine;
    } else {
      best.found.status = "failed";
      best.found.message = "the search with the final stages could not start: " + fine.found.message;
    }
  }
  enter(out.result, *best_problem, design, best);
  out.scene = with_relaxed_rest(best_problem->current());
  out.result.quantity = design.quantity_name;
  out.result.seconds = seconds_since(t0);
  return out;
}

namespace {

/// What recomputing says of targets that a search met to within `tolerance`.
std::string recomputed_message(const std::vector<DesignTargetResult>& targets, double tolerance)
{
  double worst = 0.0;
  std::size_t off = 0;
  for (const DesignTargetResult& t : targets) {
    const double off_by = t.recomputed ? std::abs(miss(t.aim, t.target, *t.recomputed)) / std::abs(t.target)
                                       : std::numeric_limits<double>::infinity();
    worst = std::max(worst, off_by);
    off += off_by > share_of_search(t.aim, tolerance) ? 1 : 0;
  }
  if (off == 0) return "every target is met to within design.tolerance";
  return fmt::format(
      "the search met every target to within design.tolerance; recomputed, {} of {} {} off by more, up to {}",
      off, targets.size(), off == 1 ? "is" : "are",
      std::isfinite(worst) ? fmt::format("{:.1f} %", 100.0 * worst) : "no limit at all");
}

}  // namespace

void finish_design(DesignResult& result, const DesignSpec& design, const std::vector<LimitResult>& initial,
                   const std::vector<LimitResult>& final)
{
  const auto before = target_values(design, initial), after = target_values(design, final);
  const std::size_t per = design.quantity == DesignQuantity::eta ? 2 : 1;
  const std::vector<std::size_t> first = target_limits(design).first;
  const auto objective = [&](const std::vector<std::optional<double>>& v) {
    double sum = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (!v[i]) return std::numeric_limits<double>::quiet_NaN();
      const double r = miss(design.targets[i].aim, design.targets[i].value, *v[i]);
      sum += 0.5 * design.targets[i].weight * r * r;
    }
    return sum;
  };
  for (std::size_t i = 0; i < result.targets.size(); ++i) {
    DesignTargetResult& t = result.targets[i];
    t.initial = before[i];
    t.recomputed = after[i];
    for (std::size_t k = first[i]; k < first[i] + per; ++k) t.better_state |= final[k].better_state;
    t.met = t.recomputed && is_within(met_share(t.aim), t.aim, t.target, *t.recomputed);
  }
  if (result.status == "targets_met") result.message = recomputed_message(result.targets, *design.tolerance);
  result.objective_initial = objective(before);
  result.objective = objective(after);
  if (result.objective > result.objective_initial) {
    result.message +=
        "; the initial design is closer to the targets: it violates a clearance, or the search needs more "
        "iterations or starts";
  }
  result.initial_limits = initial;
}

}  // namespace hauberk
