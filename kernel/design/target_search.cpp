#include "design/target_search.hpp"

#include "equilibrium/adjoint.hpp"
#include "equilibrium/barrier_path.hpp"
#include "limits/lessons.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

constexpr double same_value = 1e-9;  ///< two locked states closer than that are taken for one
/// A prediction of first order misses gaps, a tenth of the activation distance, by the square of the motion,
/// which is some times the change of shape. Where it misses more, a stage slides back through a channel as
/// narrow as its gaps, in thousands of steps: a wider stage, and those after it, take tens.
constexpr double followed_change = 0.2;
constexpr int attempts_from_rest = 2;  ///< per limit and evaluation, with different perturbations

/// Stages of a locked state as warm starts.
void enter(const Locked& l, std::vector<WarmStart>& out)
{
  for (std::size_t i = 0; i < l.trail.size(); ++i) out.push_back({l.stages[i].g_hat, l.trail[i]});
}

/// Part of a value that may depend on directions in which its state is free. What rounding and quadrature
/// leave is below 1e-8; a gradient that lacks more than this leads nowhere.
constexpr double most_undetermined = 1e-2;

/// A value along the load at the end of a stage, and its derivatives in the element parameters.
struct Value {
  double value = 0.0;
  Matrix parameters;
  long evaluations = 0;
};

/// Throws ComputationError where the state does not determine the derivatives.
Value value_of(const Model& model, const Locked& l, const MacroLoad& load, DesignValue which)
{
  const double plain = load.pull.dot(l.state.macro);
  if (which == DesignValue::plain) {
    const auto gradient_in = [&l](const Model& m, const State& state, const Vector& pull) {
      Vector quantity = Vector::Zero(m.dofs());
      quantity.head(m.macro_count) = pull;
      return adjoint_gradient(m, state, pull, l.stage, quantity);
    };
    AdjointGradient g;
    if (load.held.cols() > 0) {
      const HeldModel held(model, load.held);
      g = gradient_in(held.model(), held.restricted(l.state), held.pull(load.pull));
    } else {
      g = gradient_in(model, l.state, load.pull);
    }
    if (!(g.residual <= most_undetermined)) {
      throw ComputationError(
          fmt::format("{:.2g} of the value depends on motions that no contact resists: it has no gradient "
                      "there; design.value less_contact needs none of them",
                      g.residual));
    }
    return {plain, std::move(g.parameters), g.evaluations};
  }
  // -E = +-value - mu contact; its gradient in the parameters is explicit (envelope theorem).
  Request request;
  request.order = 1;
  request.parameters = true;
  const ContactEnergy e =
      contact_energy(model, l.state, stage_pairs(model, l.state, l.stage), l.stage.contact, request);
  return {plain - l.stage.mu * e.energy, Matrix(-l.stage.mu * e.parameters), e.evaluations};
}

}  // namespace

Locked TargetSearch::search(const DesignPoint& p, const State& start, const MacroLoad& load,
                            const Schedule& schedule, LockedTarget& counted) const
{
  Locked l = lock(p.model, start, load, scene_->limits.contact, schedule, scene_->keep_going);
  if (l.status == LockStatus::interrupted) throw Interrupted();
  counted.evaluations += l.evaluations;
  return l;
}

Locked TargetSearch::search_from_rest(const DesignPoint& p, const MacroLoad& load, int attempt,
                                      LockedTarget& counted) const
{
  const std::uint64_t seed = scene_->limits.seed + static_cast<std::uint64_t>(attempt);
  const State start = perturbed(p.model, p.rest, scene_->limits.perturbation, seed, Copies::apart);
  return search(p, start, load, schedule_, counted);
}

bool TargetSearch::lock_from_rest(const DesignPoint& p, const MacroLoad& load,
                                  const std::vector<WarmStart>& warm, const std::optional<State>& known,
                                  LockedTarget& out) const
{
  const auto value = [&load](const State& s) { return load.pull.dot(s.macro); };
  Locked found = search_from_rest(p, load, 0, out);
  const auto take_further = [&](Locked other) {
    if (other.status == LockStatus::locked &&
        (found.status != LockStatus::locked || value(other.state) > value(found.state) + same_value))
      found = std::move(other);
  };
  for (int attempt = 1; attempt < attempts_from_rest; ++attempt)
    take_further(search_from_rest(p, load, attempt, out));
  if (known) take_further(search(p, *known, load, without_widest(schedule_), out));
  if (found.status == LockStatus::stalled && !warm.empty()) return false;
  if (p.keeps_further && !warm.empty() && found.status == LockStatus::locked &&
      value(found.state) < value(warm.back().state) - schedule_.last)
    return false;
  out.followed = !warm.empty();
  out.changed = out.followed && found.status == LockStatus::locked &&
                std::abs(value(found.state) - value(warm.back().state)) > schedule_.last;
  enter(found, out.trail);
  out.locked = std::move(found);
  return true;
}

MinimumOf TargetSearch::minimum_of(const DesignPoint& p, const WarmStart& warm, const MacroLoad& load) const
{
  const ContactChoice contact = scene_->limits.contact;
  const bool last = warm.g_hat <= schedule_.last;
  double size = load_size(p.model, load.pull);
  if (load.held.cols() > 0) {
    const HeldModel held(p.model, load.held);
    size = load_size(held.model(), held.pull(load.pull));
  }
  return {barrier_stage(p.model, size, contact, schedule_,
                        planned_stage(p.model, contact, schedule_, warm.g_hat, last)),
          load};
}

bool TargetSearch::lock_by_following(const DesignPoint& p, const DesignPoint& from, const MacroLoad& load,
                                     const std::vector<WarmStart>& warm, LockedTarget& out) const
{
  const std::vector<DesignVariable>& variables = scene_->design.variables;
  const double change = largest_change_of_shape(from.model, p.model);
  for (std::size_t j = warm.size(); j-- > 1;) {
    if (warm[j].g_hat < schedule_.last) continue;
    if (j > 1 && change > followed_change * std::sqrt(warm[j].g_hat)) continue;
    std::optional<MinimumOf> minimum;
    if (scene_->limits.contact != ContactChoice::constrained) minimum = minimum_of(from, warm[j], load);
    const std::optional<State> start =
        followed(from, warm[j], p, variables, load.held, minimum ? &*minimum : nullptr, &out.evaluations);
    if (!start) continue;
    Schedule schedule = schedule_;
    schedule.first = warm[j].g_hat;
    Locked tight = search(p, *start, load, schedule, out);
    if (tight.status != LockStatus::locked) continue;
    // Looser stages of the same state: the next change of parameters may be too large for the tightest.
    for (std::size_t i = 0; i < j; ++i) {
      std::optional<State> s = followed(from, warm[i], p, variables, load.held);
      if (s) out.trail.push_back({warm[i].g_hat, std::move(*s)});
    }
    enter(tight, out.trail);
    out.followed = true;
    out.locked = std::move(tight);
    return true;
  }
  return false;
}

TargetSearch::LockedTarget TargetSearch::lock_target(const DesignPoint& p, const DesignPoint& from,
                                                     const MacroLoad& load,
                                                     const std::vector<WarmStart>& warm,
                                                     const std::optional<State>& known) const
{
  LockedTarget out;
  // What counts in the end is where rest leads. States that were followed through many designs can be
  // further, but then no load leads there.
  if (p.x == from.x && lock_from_rest(p, load, warm, known, out)) return out;
  if (lock_by_following(p, from, load, warm, out)) return out;
  // The state has no continuation that could be found.
  Locked found;
  if (!warm.empty()) {
    const std::optional<State> start = followed(from, warm.front(), p, scene_->design.variables, load.held);
    if (start) found = search(p, *start, load, schedule_, out);
    out.followed = true;
    out.changed = !start || found.status != LockStatus::locked;
  }
  for (int attempt = 0; attempt < attempts_from_rest && found.status == LockStatus::stalled; ++attempt)
    found = search_from_rest(p, load, attempt, out);
  enter(found, out.trail);
  out.locked = std::move(found);
  return out;
}

std::vector<std::optional<State>> TargetSearch::reported_states(DesignPoint& p, long& evaluations) const
{
  const ReportedStates reported = scene_->report(with_relaxed_rest(p), p.look);
  if (!scene_->keep_going()) throw Interrupted();
  evaluations += reported.evaluations;
  p.looked_in_part = reported.in_part;
  return carried_to(p, reported);
}

void TargetSearch::learn(const DesignPoint& p, const std::vector<MacroLoad>& loads, unsigned threads,
                         std::vector<LockedTarget>& targets) const
{
  Lessons rounds(targets.size(), targets.size(), std::max(1e-8, schedule_.last));
  const auto given = [&](std::size_t donor, std::size_t k) -> std::optional<double> {
    // A state that breaks what k holds is none of its own: searches from there are many steps, and seldom
    // lead on.
    const Locked& l = targets[donor].locked;
    if (l.status != LockStatus::locked || !keeps(loads[k].held, l.state.macro)) return std::nullopt;
    return loads[k].pull.dot(l.state.macro);
  };
  const auto own = [&](std::size_t k) { return given(k, k); };
  for (;;) {
    const std::vector<Lesson> lessons = rounds.next(own, given);
    if (lessons.empty()) return;
    std::vector<Locked> found(lessons.size());
    parallel_for(lessons.size(), threads, [&](std::size_t i) {
      const auto [k, donor] = lessons[i];
      try {
        found[i] = lock(p.model, targets[donor].locked.state, loads[k], scene_->limits.contact,
                        without_widest(schedule_), scene_->keep_going);
        if (found[i].status == LockStatus::interrupted) throw Interrupted();
      } catch (const ComputationError&) {
        // What cannot be computed teaches nothing: the learner keeps its own state.
      }
    });
    for (std::size_t i = 0; i < lessons.size(); ++i) {
      LockedTarget& t = targets[lessons[i].learner];
      t.evaluations += found[i].evaluations;
      const Vector& load = loads[lessons[i].learner].pull;
      if (found[i].status != LockStatus::locked ||
          !(load.dot(found[i].state.macro) > load.dot(t.locked.state.macro) + same_value))
        continue;
      t.changed = t.followed;
      t.trail.clear();
      enter(found[i], t.trail);
      t.locked = std::move(found[i]);
    }
  }
}

TargetSearch::Estimate TargetSearch::estimate(const DesignPoint& p, std::size_t task, const MacroLoad& load,
                                              LockedTarget& target) const
{
  const double sign = tasks_[task].sense == Sense::positive ? 1.0 : -1.0;
  const double scale = sign * p.model.value_unit();
  const Value v = value_of(p.model, target.locked, load, scene_->design.value);
  target.evaluations += v.evaluations;
  const std::vector<DesignVariable>& variables = scene_->design.variables;
  Estimate out{scale * v.value, Vector::Zero(static_cast<int>(variables.size()))};
  for (std::size_t i = 0; i < variables.size(); ++i) {
    for (const auto& [element, parameter] : variables[i].entries)
      out.gradient[i] += scale * v.parameters(parameter, element);
  }
  return out;
}

long TargetSearch::solve(DesignPoint& p, const DesignPoint& from, unsigned threads) const
{
  const std::size_t n = tasks_.size();
  p.evaluated = p.looked_in_part = false;
  std::vector<std::vector<WarmStart>> warm = from.warm;  // p may be `from` itself
  warm.resize(n);                                        // a starting design has none
  p.warm.assign(n, {});
  std::vector<LockedTarget> targets(n);
  std::vector<Estimate> estimates(n);
  std::vector<MacroLoad> loads;
  for (const LimitTask& task : tasks_) loads.push_back(macro_load(p.model, task.direction, task.sense));
  const auto each = [&](const auto& compute) {
    parallel_for(n, threads, [&](std::size_t k) {
      try {
        compute(k);
      } catch (const ComputationError& e) {  // of this design, which is one of many
        targets[k].problem = e.what();
      }
    });
  };
  const auto has_problem = [](const LockedTarget& t) { return !t.problem.empty(); };
  long evaluations = 0;
  std::vector<std::optional<State>> known(n);
  if (p.look != Look::usual && p.x == from.x && scene_->report) known = reported_states(p, evaluations);
  each([&](std::size_t k) { targets[k] = lock_target(p, from, loads[k], warm[k], known[k]); });
  p.continued = p.x != from.x && std::any_of(targets.begin(), targets.end(),
                                             [](const LockedTarget& t) { return t.followed && !t.changed; });
  if (std::none_of(targets.begin(), targets.end(), has_problem)) learn(p, loads, threads, targets);
  each([&](std::size_t k) {
    if (targets[k].locked.status != LockStatus::locked) return;
    p.warm[k] = targets[k].trail;
    estimates[k] = estimate(p, k, loads[k], targets[k]);
  });
  p.changed.clear();
  for (std::size_t k = 0; k < n; ++k) {
    evaluations += targets[k].evaluations;
    if (targets[k].changed) p.changed.push_back(static_cast<int>(k));
    const bool locked = targets[k].locked.status == LockStatus::locked;
    if (!p.why.empty() || (locked && targets[k].problem.empty())) continue;
    p.why = fmt::format("no {} at {}: {}", locked ? "gradient" : "limit", tasks_[k].direction.text(),
                        has_problem(targets[k]) ? targets[k].problem : targets[k].locked.message);
  }
  if (p.why.empty()) enter_objective(p, estimates);
  return evaluations;
}

void TargetSearch::enter_objective(DesignPoint& p, const std::vector<Estimate>& estimates) const
{
  const DesignSpec& design = scene_->design;
  const auto nv = static_cast<int>(design.variables.size());
  const auto nt = static_cast<int>(design.targets.size());
  p.value_gradients = Matrix::Zero(nt, nv);
  p.values.assign(design.targets.size(), 0.0);
  p.objective = 0.0;
  p.gradient = Vector::Zero(nv);
  for (int i = 0; i < nt; ++i) {
    const std::size_t k = i;
    if (design.quantity == DesignQuantity::eta) {
      // eta = (s - c)/(1 + c)
      const auto& [s, ds] = estimates[first_[k]];
      const auto& [c, dc] = estimates[first_[k] + 1];
      p.values[k] = (s - c) / (1.0 + c);
      p.value_gradients.row(i) = (ds / (1.0 + c) - dc * (1.0 + s) / ((1.0 + c) * (1.0 + c))).transpose();
    } else {
      p.values[k] = estimates[first_[k]].value;
      p.value_gradients.row(i) = estimates[first_[k]].gradient.transpose();
    }
    const DesignTarget& t = design.targets[k];
    const double r = miss(t.aim, t.value, p.values[k]);
    p.objective += 0.5 * t.weight * r * r;
    p.gradient += t.weight * r * p.value_gradients.row(i).transpose();
  }
  p.evaluated = true;
}

}  // namespace hauberk
