#include "design/design_problem.hpp"

#include "equilibrium/relaxation.hpp"
#include "model/links.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hauberk {
namespace {

constexpr double smallest_share = 1e-3;
/// Starting designs: moves towards the random goal, each on newly linearised constraints.
constexpr int most_start_moves = 8;
constexpr int most_halvings = 6;
constexpr double start_violation = 1e-4;  ///< L; the optimizer mends it
/// Accepted designs in a row with states that were only continued: then they are looked for from rest.
constexpr int most_unchecked = 4;

/// Throws InputError of a solid that does not say how far its surface moves on the way to other sizes.
void refuse_unknown_motion(const Model& model)
{
  for (const Body& b : model.bodies) {
    if (!b.solid) continue;
    const bool known =
        b.solid->with_sizes(b.solid->sizes()) && std::isfinite(b.solid->speed(b.solid->sizes()));
    if (!known)
      throw InputError(fmt::format(
          "designs of '{}' are not known: its plugin gives no with_sizes() and speed(), which say how "
          "far its surface moves on the way to other sizes",
          b.solid->kind()));
  }
}

std::vector<double> copy(std::span<const double> x) { return {x.begin(), x.end()}; }

}  // namespace

DesignProblem::DesignProblem(DesignScene scene, std::uint64_t stream)
    : scene_(std::make_shared<const DesignScene>(std::move(scene))),
      stream_(stream),
      journal_(scene_),
      rest_path_(scene_),
      current_(start_point()),
      last_(current_)
{
  for (const DesignVariable& v : scene_->design.variables) {
    lower_.push_back(v.lower);
    upper_.push_back(v.upper);
  }
  constraints_ = std::make_shared<const DesignConstraints>(scene_, *current_);
}

std::shared_ptr<DesignPoint> DesignProblem::start_point() const
{
  auto p = std::make_shared<DesignPoint>();
  p->x = scene_variables();
  p->spec = scene_->scene;
  p->model = make_model(scene_->scene, scene_->load, scene_->clearance);
  refuse_unknown_motion(p->model);
  const double target = scene_->rest_target(p->model);
  const Relaxed r =
      relax(p->model, rest_state(p->model), target, Cell::fixed, most_relaxations, scene_->keep_going);
  if (!r.problem.empty())
    throw InputError("the initial design has no rest state with the wanted clearance: " + r.problem +
                     tightest_pair(scene_->scene, p->model, r.state));
  p->rest = r.state;
  p->rest_gaps = find_gaps(p->model, p->rest, target + response_range, true);
  p->warm.resize(journal_.task_count());
  return p;
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
  p->spec = with_variables(scene_->scene, scene_->design.variables, x);
  last_ = p;
  try {
    p->model = make_model(p->spec, scene_->load, scene_->clearance);
  } catch (const InputError& e) {
    p->why = e.what();
    return p;
  }
  // Links are those at the rest state, not at the reference positions, and cannot change on a way without
  // collisions; but where loops of the elements themselves come or go they have to be counted anew.
  const bool carried = same_loops(p->model, current_->model);
  if (carried) p->model.links = current_->model.links;
  const RestPath::End& way = rest_path_.follow(current_, *p);
  if (way.share < 1.0) {
    p->why = "elements collide at rest on the way";
    return p;
  }
  p->rest = way.rest;
  if (!carried) p->model.links = find_links(p->model, p->rest);
  p->rest_gaps = find_gaps(p->model, p->rest, scene_->rest_target(p->model) + response_range, true);
  return p;
}

OptimizationProblem::Evaluation DesignProblem::evaluate(std::span<const double> x, bool want_gradient)
{
  return evaluate_batch(1, x, want_gradient).front();
}

std::vector<OptimizationProblem::Evaluation> DesignProblem::evaluate_batch(std::size_t count,
                                                                           std::span<const double> points,
                                                                           bool want_gradient)
{
  check_batch(count, points);
  std::vector<std::shared_ptr<DesignPoint>> all, open;
  for (std::size_t i = 0; i < count; ++i) {
    const std::shared_ptr<DesignPoint> p = make_point(points.subspan(i * lower_.size(), lower_.size()));
    all.push_back(p);
    if (!p->why.empty() || p->evaluated || std::find(open.begin(), open.end(), p) != open.end()) continue;
    open.push_back(p);
    tried_.push_back(p);
  }
  // All others start from the states of the iterate, which has to have some.
  const auto iterate = std::find(open.begin(), open.end(), current_);
  if (iterate != open.end()) {
    journal_.evaluate({current_}, *current_);
    open.erase(iterate);
  }
  journal_.evaluate(open, *current_);
  std::vector<Evaluation> found;
  for (const std::shared_ptr<DesignPoint>& p : all) {
    Evaluation& e = found.emplace_back();
    e.ok = p->evaluated && std::isfinite(p->objective);
    e.why = p->why;
    if (!e.ok) continue;
    e.value = p->objective;
    if (want_gradient) e.gradient.assign(p->gradient.data(), p->gradient.data() + p->gradient.size());
  }
  return found;
}

bool DesignProblem::residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (!p->evaluated) return false;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < scene_->design.targets.size(); ++i) {
    const DesignTarget& t = scene_->design.targets[i];
    const double w = std::sqrt(t.weight);
    r[i] = w * miss(t.aim, t.value, p->values[i]);
    const double slope = t.aim != Aim::reach && r[i] == 0.0 ? 0.0 : w;  // a bound that is kept has none
    for (std::size_t v = 0; v < x.size(); ++v)
      jacobian[entry++] = slope * p->value_gradients(static_cast<int>(i), static_cast<int>(v));
  }
  return true;
}

void DesignProblem::constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian)
{
  constraints_->evaluate(*make_point(x), current_->model, c, jacobian);
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
    end.spec = with_variables(scene_->scene, scene_->design.variables, end.x);
    try {
      end.model = make_model(end.spec, scene_->load, scene_->clearance);
      return share * rest_path_.follow(current_, end).share;
    } catch (const InputError&) {
      share *= 0.5;
    }
  }
  return 0.0;
}

void DesignProblem::set_schedule(const Schedule& schedule, Look look_at_the_goal)
{
  journal_.set_schedule(schedule);
  look_at_the_goal_ = look_at_the_goal;
  current_ = last_ = std::make_shared<DesignPoint>(*current_);
  current_->evaluated = false;
  current_->why.clear();
  current_->look = Look::usual;
  current_->checked = false;
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
  std::vector<double> c(constraint_count());
  std::vector<double> jacobian(c.size() * d.size());
  for (int move = 0; move < most_start_moves; ++move) {
    constraints(current_->x, c, jacobian);
    const std::vector<double> x0 = current_->x;
    const std::vector<double> x = project(c, jacobian, x0, goal, scene_->design.variables);
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

void DesignProblem::accept(std::span<const double> x)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (!p->evaluated)
    throw PluginError("the optimizer accepted a design that it " + (p->why.empty()
                                                                        ? "did not evaluate from its iterate"
                                                                        : "could not evaluate: " + p->why));
  // What ends a design has to be what its limits are recomputed as.
  const bool at_the_goal = meets_targets(scene_->design, p->values);
  p->look = at_the_goal ? look_at_the_goal_ : Look::usual;
  p->keeps_further = found_further_ && !at_the_goal;
  take(p, p->unchecked >= most_unchecked || at_the_goal);
}

void DesignProblem::take(const std::shared_ptr<DesignPoint>& p, bool look_from_rest)
{
  if (look_from_rest) journal_.check(*p, *current_);
  journal_.keep_states(*p, *current_);
  tried_.clear();  // from the former iterate; from this one they may come out otherwise
  current_ = last_ = p;
  accepted_.push_back(p);
  if (p->unchecked > 0 || (confirmed_ && confirmed_->objective <= p->objective)) return;
  if (constraints_->satisfied(*p, p->model)) confirmed_ = p;
}

bool DesignProblem::settle()
{
  if (current_->unchecked > 0) take(current_, true);
  if (!confirmed_ || confirmed_->objective >= current_->objective) return false;
  take(confirmed_, false);
  return true;
}

bool DesignProblem::confirm()
{
  if (current_ == last_thorough_) return false;
  current_->look = Look::whole;
  current_->keeps_further = false;
  take(current_, true);
  last_thorough_ = current_;
  const bool further = !current_->changed.empty();
  const bool keeps_clearances = constraints_->satisfied(*current_, current_->model);
  if (further) {
    // Objectives of iterates that were not looked at so thoroughly cannot be compared with this one's.
    confirmed_ = keeps_clearances ? current_ : nullptr;
    found_further_ = true;
  }
  if (keeps_clearances && (!best_thorough_ || current_->objective < best_thorough_->objective))
    best_thorough_ = current_;
  return further;
}

bool DesignProblem::take_best_confirmed()
{
  if (!best_thorough_ || best_thorough_ == current_ || best_thorough_->objective >= current_->objective)
    return false;
  take(best_thorough_, false);
  return true;
}

double DesignProblem::rest_distance() const
{
  const Model& m = current_->model;
  return (smallest_gap(m, current_->rest, constrained_range) + m.clearance) * m.length;
}

}  // namespace hauberk
