#include <hauberk/design/design_problem.hpp>
#include <hauberk/error.hpp>
#include <hauberk/motion/advancement.hpp>

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
/// Rest states are followed in at most so many parts, each of this share of what is safe.
constexpr int most_rest_parts = 24;
constexpr double most_of_safe = 0.9;
/// Gaps beyond the required ones (L) that the states between keep if they can: the next part is then longer.
constexpr double rest_room = 0.01;
constexpr int rest_iterations = 12;
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
    throw InputError("the initial design has no rest state with the wanted clearance: " + r.problem +
                     tightest_pair(scene_, p->model, r.state));
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
    // Of a tube around a curve nobody knows how wide its hole is; links and rest gaps hold it open.
    if (current_->model.bodies[static_cast<std::size_t>(ring)].curve) return;
    for (const int k : {4, 5}) {
      for (const Hole& h : holes_) {
        if (h.ring == ring && h.thread == thread && h.size_index == k) return;
      }
      holes_.push_back({ring, thread, k});
    }
  };
  for (const Link& l : m.links) {
    // Nor how wide a loop is that several primitives form.
    if (std::max(l.a, l.b) >= static_cast<int>(m.bodies.size())) continue;
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
  const auto is_at = [x](const auto& p) { return std::equal(x.begin(), x.end(), p->x.begin(), p->x.end()); };
  if (is_at(current_)) return current_;
  if (is_at(last_)) return last_;
  for (const auto* points : {&tried_, &accepted_}) {
    const auto known = std::find_if(points->begin(), points->end(), is_at);
    if (known != points->end()) return *known;
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
  const RestPath& way = follow_rest(*p);
  if (way.share < 1.0) {
    p->why = "elements collide at rest on the way";
    return p;
  }
  p->rest = way.rest;
  p->rest_gaps = find_gaps(p->model, p->rest, rest_target(p->model) + response_range, true);
  return p;
}

OptimizationProblem::Evaluation DesignProblem::evaluate(std::span<const double> x, bool want_gradient)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (p->why.empty() && !p->evaluated) find_targets(p);
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

double DesignProblem::hole_room(const Model& m, const Hole& h) const
{
  const Body& ring = m.bodies[static_cast<std::size_t>(h.ring)];
  const Body& thread = m.bodies[static_cast<std::size_t>(h.thread)];
  return ring.R - ring.r0 - (h.size_index == 4 ? thread.r0 : thread.r1) - design_.hole_clearance / m.length;
}

std::string DesignProblem::impossible_hole()
{
  const std::size_t nv = lower_.size();
  std::vector<double> c(static_cast<std::size_t>(constraint_count())), jacobian(c.size() * nv);
  constraints(current_->x, c, jacobian);
  double least = 0.0;
  std::string text;
  for (std::size_t row = 0; row < holes_.size(); ++row) {
    std::vector<double> x = current_->x;
    for (std::size_t v = 0; v < nv; ++v) {
      const double slope = jacobian[row * nv + v];
      if (slope != 0.0) x[v] = slope > 0.0 ? upper_[v] : lower_[v];
    }
    const Model most = make_model(with_variables(scene_, design_.variables, x), load_, clearance_);
    const double room = hole_room(most, holes_[row]);
    if (room >= least) continue;
    least = room;
    const Gap pair{holes_[row].ring, holes_[row].thread, {}, 0.0, {}, {}, {}};
    text = fmt::format(
        "{0:.6g} {1} is more than the bounds of the variables allow: at most {2:.6g} {1} are left in the "
        "hole "
        "of the first of {3}; widen the bounds, or lower it",
        design_.hole_clearance, scene_.length_unit, room * most.length + design_.hole_clearance,
        pair_name(scene_, most, pair));
  }
  return text;
}

void DesignProblem::constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  const auto nv = static_cast<int>(design_.variables.size());
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  const Model& m = p->model.bodies.empty() ? current_->model : p->model;
  std::size_t row = 0;
  for (const Hole& h : holes_) {
    c[row] = hole_room(m, h);
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
  DesignPoint end;
  // Parameters must stay admissible for the shape; halve until they are.
  double share = 1.0;
  while (share > smallest_share) {
    end.x = copy(x);
    for (std::size_t k = 0; k < d.size(); ++k) end.x[k] += share * d[k];
    end.spec = with_variables(scene_, design_.variables, end.x);
    try {
      end.model = make_model(end.spec, load_, clearance_);
      return share * follow_rest(end).share;
    } catch (const InputError&) {
      share *= 0.5;
    }
  }
  return 0.0;
}

const DesignProblem::RestPath& DesignProblem::follow_rest(const DesignPoint& to)
{
  if (way_from_ != current_ || way_to_ != to.x) {
    way_ = rest_path(to);
    way_from_ = current_;
    way_to_ = to.x;
  }
  return way_;
}

DesignProblem::RestPath DesignProblem::rest_path(const DesignPoint& to) const
{
  DesignPoint at;
  at.model = current_->model;
  at.rest = current_->rest;
  at.rest_gaps = current_->rest_gaps;
  const Vector change = change_of_variables(*current_, to);
  RestPath way{0.0, at.rest};
  double longest = 1.0;
  for (int parts = 0; parts < most_rest_parts && way.share < 1.0; ++parts) {
    // Predicted along the response as far as nothing collides, then relaxed.
    const Matrix response = rest_response(at, design_.variables);
    double part = std::min(1.0 - way.share, longest);
    double end = 1.0;
    std::optional<Model> next;
    Vector dy;
    for (double safe = 0.0; safe < 1.0;) {
      if (part < smallest_share) return way;
      end = part < 1.0 - way.share ? way.share + part : 1.0;
      next = intermediate(*current_, to, design_.variables, end);
      dy = response * (part * change);
      safe = next ? safe_parameter_step(at.model, *next, at.rest, dy) : 0.5;
      if (safe < 1.0) part *= most_of_safe * safe;
    }
    const State predicted = advanced(at.model, at.rest, dy, 1.0);
    longest = 2.0 * part;
    way.share = end;
    const Relaxed r = way.share < 1.0 ? relax(*next, predicted, rest_target(*next) + rest_room, Cell::fixed,
                                              rest_iterations)
                                      : relax(*next, predicted, rest_target(*next));
    const Vector back = difference(*next, predicted, r.state);
    const bool passes = r.moved && hauberk::largest_safe_step(*next, predicted, back, 0.02).alpha < 1.0;
    at.rest = passes ? predicted : r.state;
    at.model = std::move(*next);
    at.rest_gaps = find_gaps(at.model, at.rest, rest_target(at.model) + response_range, true);
    way.rest = at.rest;
  }
  return way;
}

void DesignProblem::set_schedule(const Schedule& schedule)
{
  schedule_ = schedule;
  current_ = last_ = std::make_shared<DesignPoint>(*current_);
  current_->evaluated = false;
  current_->why.clear();
  current_->states_missing = current_->states_kept = false;
  tried_.clear();  // their values are of the other stages
  accepted_.clear();
  confirmed_.reset();
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
