#include <hauberk/design/design_problem.hpp>
#include <hauberk/error.hpp>
#include <hauberk/motion/advancement.hpp>
#include <hauberk/parallel.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Pairs up to this far apart at the first rest state (L) are held apart by constraints of their own; all
/// others by the collision check alone.
constexpr double constrained_range = 0.3;
/// Gaps within this of the required clearance respond together when parameters change (L).
constexpr double response_range = 0.03;
constexpr double smallest_share = 1e-3;
constexpr double same_value = 1e-9;    ///< two locked states closer than that are taken for one
constexpr int attempts_from_rest = 2;  ///< per limit and evaluation, with different perturbations
/// Starting designs: moves towards the random goal, each on newly linearised constraints.
constexpr int most_start_moves = 8;
constexpr int projection_sweeps = 200;
constexpr int most_halvings = 6;
constexpr double start_violation = 1e-4;  ///< L; the optimizer mends it

std::vector<double> copy(std::span<const double> x) { return {x.begin(), x.end()}; }

}  // namespace

DesignProblem::DesignProblem(const SceneSpec& scene, const LoadCase& load, double clearance,
                             const LimitSettings& limits, const DesignSpec& design, unsigned threads,
                             KeepGoing keep_going)
    : scene_(scene),
      load_(load),
      clearance_(clearance),
      limits_(limits),
      design_(design),
      threads_(threads),
      keep_going_(std::move(keep_going)),
      schedule_(design.schedule),
      tasks_(target_tasks(design))
{
  for (const DesignVariable& v : design_.variables) {
    lower_.push_back(v.lower);
    upper_.push_back(v.upper);
  }
  auto p = std::make_shared<DesignPoint>();
  p->x = scene_variables();
  p->spec = scene_;
  p->model = make_model(scene_, load_, clearance_);
  const Relaxed r = relax(p->model, rest_state(p->model), rest_target(p->model));
  if (!r.problem.empty())
    throw InputError("the initial design has no rest state with the wanted clearance: " + r.problem);
  p->rest = r.state;
  p->rest_gaps = find_gaps(p->model, p->rest, rest_target(p->model) + response_range, true);
  p->warm.resize(tasks_.size());
  current_ = last_ = p;
  list_constraints();
}

double DesignProblem::rest_target(const Model& m) const
{
  return design_.rest_clearance / m.length - m.clearance;
}

std::vector<double> DesignProblem::scene_variables() const
{
  std::vector<double> x;
  for (const DesignVariable& v : design_.variables) {
    const auto& [element, parameter] = v.entries.front();
    x.push_back(
        scene_.elements[static_cast<std::size_t>(element)].parameters[static_cast<std::size_t>(parameter)]);
  }
  return x;
}

void DesignProblem::list_constraints()
{
  const Model& m = current_->model;
  const auto add_hole = [this](int ring, int thread) {
    for (const int k : {4, 5}) {
      for (const Hole& h : holes_) {
        if (h.ring == ring && h.thread == thread && h.size_index == k) return;
      }
      holes_.push_back({ring, thread, k});
    }
  };
  for (const Link& l : m.links) {
    add_hole(l.a, l.b);
    add_hole(l.b, l.a);
  }
  for (const Gap& g : find_gaps(m, current_->rest, constrained_range, false)) {
    const bool known = std::any_of(pairs_.begin(), pairs_.end(), [&g](const Pair& p) {
      return p.a == g.a && p.b == g.b && p.image == g.image;
    });
    if (!known) pairs_.push_back({g.a, g.b, g.image});
  }
}

std::shared_ptr<DesignPoint> DesignProblem::make_point(std::span<const double> x)
{
  if (std::equal(x.begin(), x.end(), current_->x.begin(), current_->x.end())) return current_;
  if (std::equal(x.begin(), x.end(), last_->x.begin(), last_->x.end())) return last_;
  for (const auto& known : accepted_) {
    if (std::equal(x.begin(), x.end(), known->x.begin(), known->x.end())) return known;
  }
  auto p = std::make_shared<DesignPoint>();
  p->x = copy(x);
  p->spec = with_variables(scene_, design_.variables, x);
  last_ = p;
  try {
    p->model = make_model(p->spec, load_, clearance_);
  } catch (const InputError& e) {
    p->why = e.what();
    return p;
  }
  p->model.links = current_->model.links;  // found at the rest state, not at the reference positions
  // Rest: predicted along the response, then relaxed; both parts of the way are checked.
  Vector dx(static_cast<int>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) dx[static_cast<int>(k)] = x[k] - current_->x[k];
  const Vector dy = rest_response(*current_, design_.variables) * dx;
  if (safe_parameter_step(current_->model, p->model, current_->rest, dy) < 1.0) {
    p->why = "elements collide at rest on the way";
    return p;
  }
  const State predicted = advanced(current_->model, current_->rest, dy, 1.0);
  const Relaxed r = relax(p->model, predicted, rest_target(p->model));
  if (r.moved &&
      hauberk::largest_safe_step(p->model, predicted, difference(p->model, predicted, r.state), 0.02).alpha <
          1.0) {
    p->why = "relaxing the rest state would pass through an element";
    return p;
  }
  p->rest = r.state;
  p->rest_gaps = find_gaps(p->model, p->rest, rest_target(p->model) + response_range, true);
  return p;
}

Locked DesignProblem::lock_target(const DesignPoint& p, const Vector& load,
                                  const std::vector<WarmStart>& warm, std::vector<WarmStart>& trail,
                                  long& evaluations) const
{
  const auto run = [&](const State& from, const Schedule& schedule) {
    Locked l = lock(p.model, from, load, limits_.contact, schedule, keep_going_);
    evaluations += l.evaluations;
    return l;
  };
  const auto enter = [](const Locked& l, std::vector<WarmStart>& out) {
    for (std::size_t i = 0; i < l.trail.size(); ++i) out.push_back({l.stages[i].g_hat, l.trail[i]});
  };
  // A limit is the furthest locked state. One search starts loose, and may find another state than the
  // iterate's; one follows the iterate's state, which may be further, as tightly as it can.
  Locked loose;
  if (!warm.empty()) {
    const std::optional<State> start = followed(*current_, warm.front(), p, design_.variables);
    if (start) loose = run(*start, schedule_);
  }
  for (int attempt = 0; attempt < attempts_from_rest && loose.status == LockStatus::stalled; ++attempt) {
    const std::uint64_t seed = limits_.seed + static_cast<std::uint64_t>(attempt);
    loose = run(perturbed(p.model, p.rest, limits_.perturbation, seed), schedule_);
  }
  if (loose.status != LockStatus::locked && loose.status != LockStatus::stalled) return loose;
  for (std::size_t j = warm.size(); j-- > 1;) {
    if (warm[j].g_hat < schedule_.last) continue;
    const std::optional<State> start = followed(*current_, warm[j], p, design_.variables);
    if (!start) continue;
    Schedule schedule = schedule_;
    schedule.first = warm[j].g_hat;
    Locked tight = run(*start, schedule);
    if (tight.status != LockStatus::locked) continue;
    const bool further = loose.status != LockStatus::locked ||
                         load.dot(tight.state.macro) > load.dot(loose.state.macro) + same_value;
    if (!further) break;
    if (!loose.trail.empty()) trail.push_back({loose.stages.front().g_hat, loose.trail.front()});
    // Looser stages of the same state: the next change of parameters may be too large for the tightest.
    for (std::size_t i = loose.trail.empty() ? 0 : 1; i < j; ++i) {
      std::optional<State> s = followed(*current_, warm[i], p, design_.variables);
      if (s) trail.push_back({warm[i].g_hat, std::move(*s)});
    }
    enter(tight, trail);
    return tight;
  }
  enter(loose, trail);
  return loose;
}

void DesignProblem::solve_targets(DesignPoint& p)
{
  std::vector<std::vector<WarmStart>> warm = current_->warm;  // p may be the iterate itself
  warm.resize(tasks_.size());                                 // a starting design has none
  p.warm.assign(tasks_.size(), {});
  std::vector<Locked> locked(tasks_.size());
  std::vector<double> estimate(tasks_.size());
  std::vector<long> evaluations(tasks_.size(), 0);
  std::vector<Vector> gradient(tasks_.size());
  const auto nv = static_cast<int>(design_.variables.size());
  parallel_for(tasks_.size(), threads_, [&](std::size_t k) {
    const Vector load = load_vector(p.model, tasks_[k].direction_deg * degree, tasks_[k].sense);
    locked[k] = lock_target(p, load, warm[k], p.warm[k], evaluations[k]);
    const Locked& l = locked[k];
    if (l.status != LockStatus::locked) return;
    // -E = +-value - mu contact; its gradient in the parameters is explicit (envelope theorem).
    Request request;
    request.order = 1;
    request.parameters = true;
    const ContactEnergy e =
        contact_energy(p.model, l.state, stage_pairs(p.model, l.state, l.stage), l.stage.contact, request);
    const double scale = std::pow(p.model.length, load_.value_length_power());
    const double sign = tasks_[k].sense == Sense::positive ? 1.0 : -1.0;
    estimate[k] = sign * (load.dot(l.state.macro) - l.stage.mu * e.energy) * scale;
    gradient[k] = Vector::Zero(nv);
    for (int v = 0; v < nv; ++v) {
      for (const auto& [element, parameter] : design_.variables[static_cast<std::size_t>(v)].entries) {
        gradient[k][v] -= sign * l.stage.mu * e.parameters(parameter, element) * scale;
      }
    }
  });
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    evaluations_ += evaluations[k];
    if (locked[k].status != LockStatus::locked) {
      p.why = fmt::format("no limit at {} degrees: {}", tasks_[k].direction_deg, locked[k].message);
      return;
    }
  }
  const auto nt = static_cast<int>(design_.targets.size());
  p.value_gradients = Matrix::Zero(nt, nv);
  p.values.assign(design_.targets.size(), 0.0);
  p.objective = 0.0;
  p.gradient = Vector::Zero(nv);
  for (int i = 0; i < nt; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (design_.quantity == DesignQuantity::eta) {
      // eta = (s - c)/(1 + c)
      const double s = estimate[2 * k], c = estimate[2 * k + 1];
      p.values[k] = (s - c) / (1.0 + c);
      p.value_gradients.row(i) =
          (gradient[2 * k] / (1.0 + c) - gradient[2 * k + 1] * (1.0 + s) / ((1.0 + c) * (1.0 + c)))
              .transpose();
    } else {
      p.values[k] = estimate[k];
      p.value_gradients.row(i) = gradient[k].transpose();
    }
    const DesignTarget& t = design_.targets[k];
    const double r = p.values[k] - t.value;
    p.objective += 0.5 * t.weight * r * r;
    p.gradient += t.weight * r * p.value_gradients.row(i).transpose();
  }
  p.evaluated = true;
}

OptimizationProblem::Evaluation DesignProblem::evaluate(std::span<const double> x, bool want_gradient)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (p->why.empty() && !p->evaluated) solve_targets(*p);
  Evaluation e;
  e.ok = p->evaluated && std::isfinite(p->objective);
  e.why = p->why;
  if (!e.ok) return e;
  e.value = p->objective;
  if (want_gradient) e.gradient.assign(p->gradient.data(), p->gradient.data() + p->gradient.size());
  return e;
}

bool DesignProblem::residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (!p->evaluated) return false;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < design_.targets.size(); ++i) {
    const DesignTarget& t = design_.targets[i];
    const double w = std::sqrt(t.weight);
    r[i] = w * (p->values[i] - t.value);
    for (std::size_t v = 0; v < x.size(); ++v)
      jacobian[entry++] = w * p->value_gradients(static_cast<int>(i), static_cast<int>(v));
  }
  return true;
}

void DesignProblem::constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  const auto nv = static_cast<int>(design_.variables.size());
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  const Model& m = p->model.bodies.empty() ? current_->model : p->model;
  const double L = m.length;
  std::size_t row = 0;
  for (const Hole& h : holes_) {
    const Body& ring = m.bodies[static_cast<std::size_t>(h.ring)];
    const Body& thread = m.bodies[static_cast<std::size_t>(h.thread)];
    c[row] = ring.R - ring.r0 - (h.size_index == 4 ? thread.r0 : thread.r1) - design_.hole_clearance / L;
    if (!jacobian.empty()) {
      const auto add = [&](int body, int quantity, double factor) {
        const int element = m.bodies[static_cast<std::size_t>(body)].element;
        for (int v = 0; v < nv; ++v) {
          for (const auto& [el, parameter] : design_.variables[static_cast<std::size_t>(v)].entries) {
            if (el != element) continue;
            jacobian[row * static_cast<std::size_t>(nv) + static_cast<std::size_t>(v)] +=
                factor * m.size_derivative(static_cast<std::size_t>(body), quantity, parameter);
          }
        }
      };
      add(h.ring, 3, 1.0);
      add(h.ring, 4, -1.0);
      add(h.thread, h.size_index, -1.0);
    }
    ++row;
  }
  if (!p->why.empty() && p->rest_gaps.empty()) {  // no rest state: as infeasible as can be said
    for (; row < c.size(); ++row) c[row] = -1.0;
    return;
  }
  const double target = rest_target(m);
  const Matrix response = jacobian.empty() ? Matrix() : rest_response(*p, design_.variables);
  for (const Pair& pair : pairs_) {
    c[row] = response_range;  // farther than that: not binding, no gradient
    const Gap* closest = nullptr;
    for (const Gap& g : p->rest_gaps) {
      if (g.a == pair.a && g.b == pair.b && g.image == pair.image && g.gap - target < c[row]) {
        c[row] = g.gap - target;
        closest = &g;
      }
    }
    if (closest != nullptr && !jacobian.empty()) {
      const Vector d =
          gap_parameter_gradient(*closest, *p, design_.variables) + response.transpose() * closest->dy;
      for (int v = 0; v < nv; ++v)
        jacobian[row * static_cast<std::size_t>(nv) + static_cast<std::size_t>(v)] = d[v];
    }
    ++row;
  }
}

double DesignProblem::largest_safe_step(std::span<const double> x, std::span<const double> d)
{
  if (!std::equal(x.begin(), x.end(), current_->x.begin(), current_->x.end())) return 0.0;
  std::vector<double> end = copy(x);
  Vector dx(static_cast<int>(d.size()));
  for (std::size_t k = 0; k < d.size(); ++k) {
    dx[static_cast<int>(k)] = d[k];
    end[k] += d[k];
  }
  double share = 1.0;
  // Parameters must stay admissible for the shape; halve until they are.
  while (share > smallest_share) {
    std::vector<double> y(end.size());
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = x[k] + share * d[k];
    try {
      const Model m = make_model(with_variables(scene_, design_.variables, y), load_, clearance_);
      const Vector dy = rest_response(*current_, design_.variables) * (share * dx);
      return share * safe_parameter_step(current_->model, m, current_->rest, dy);
    } catch (const InputError&) {
      share *= 0.5;
    }
  }
  return 0.0;
}

void DesignProblem::set_schedule(const Schedule& schedule)
{
  schedule_ = schedule;
  current_ = last_ = std::make_shared<DesignPoint>(*current_);
  current_->evaluated = false;
  current_->why.clear();
  accepted_.clear();  // their values are of the other stages
}

void DesignProblem::accept(std::span<const double> x)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (!p->evaluated)
    throw PluginError("the optimizer accepted a design that it could not evaluate: " + p->why);
  current_ = p;
  accepted_.push_back(p);
}

std::vector<double> DesignProblem::feasible_towards(std::span<const double> d)
{
  std::vector<double> goal(d.size());
  for (std::size_t i = 0; i < d.size(); ++i)
    goal[i] = std::clamp(current_->x[i] + d[i], lower_[i], upper_[i]);
  std::vector<double> c(static_cast<std::size_t>(constraint_count()));
  std::vector<double> jacobian(c.size() * d.size());
  for (int move = 0; move < most_start_moves; ++move) {
    // The nearest point to the goal that satisfies the linearised constraints, by cyclic projections.
    constraints(current_->x, c, jacobian);
    const std::vector<double> x0 = current_->x;
    std::vector<double> x = goal;
    for (int sweep = 0; sweep < projection_sweeps; ++sweep) {
      for (std::size_t r = 0; r < c.size(); ++r) {
        const double* row = jacobian.data() + r * x.size();
        double value = c[r], norm = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
          value += row[i] * (x[i] - x0[i]);
          norm += row[i] * row[i];
        }
        if (value >= 0.0 || norm == 0.0) continue;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= value / norm * row[i];
      }
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], lower_[i], upper_[i]);
    }
    bool moved = false;
    double share = 1.0;
    for (int k = 0; k < most_halvings && !moved; ++k, share *= 0.5) {
      std::vector<double> y(x.size());
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = x0[i] + share * (x[i] - x0[i]);
      const auto p = make_point(y);
      if (!p->why.empty()) continue;
      constraints(y, c, {});
      if (*std::min_element(c.begin(), c.end()) < -start_violation) continue;
      current_ = p;
      moved = true;
    }
    if (!moved || share > 0.6) break;  // blocked, or all the way
  }
  return current_->x;
}

double DesignProblem::rest_distance() const
{
  const Model& m = current_->model;
  return (smallest_gap(m, current_->rest, constrained_range) + m.clearance) * m.length;
}

}  // namespace hauberk
