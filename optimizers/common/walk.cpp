#include "walk.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Steps onto the constraints; each is one of Newton's method.
constexpr int most_restorations = 5;
/// Rounding of two points on one ray, over the larger of 1 and the scaled point.
constexpr double rounding = 1e-14;

}  // namespace

Walk::Walk(OptimizationProblem& problem, const WalkSettings& settings, OptimizerObserver& observer,
           std::span<const double> start)
    : problem_(problem, start), settings_(settings), observer_(observer), best_(settings.constraint_tolerance)
{
  accepted_.x = Eigen::Map<const VectorXd>(start.data(), static_cast<Index>(start.size()));
}

bool Walk::begin(bool want_gradient, std::string& why)
{
  const Trial trial = problem_.begin(accepted_.x, accepted_.at, want_gradient);
  accepted_.value = first_value_ = trial.value;
  why = trial.why;
  if (!trial.ok) return false;
  unit_ = objective_scale(first_value_, first_value_);
  accepted_.ok = true;
  accepted_.derivatives = want_gradient;
  best_.offer(accepted_.x, accepted_.value, largest_violation(accepted_.at));
  best_place_ = last_ = accepted_;
  report(0.0);
  return true;
}

const Walk::Place& Walk::look(const VectorXd& x, bool want_gradient)
{
  const auto known = [&](const Place& p) { return p.x == x && (!want_gradient || p.derivatives || !p.ok); };
  if (known(accepted_)) return accepted_;
  if (known(last_)) return last_;
  last_ = {};
  last_.x = x;
  if (stop_ != Stop::none || !x.allFinite()) return last_;
  blocked_ = !reachable(x);
  if (blocked_) return last_;
  if (problem_.evaluations() >= settings_.max_evaluations)
    stop_ = Stop::evaluations;
  else
    evaluate(last_, want_gradient);
  return last_;
}

std::vector<Walk::Place> Walk::look(const std::vector<VectorXd>& points, bool want_gradient)
{
  std::vector<Place> places(points.size());
  std::vector<std::size_t> asked;  // to be evaluated
  std::vector<VectorXd> there;
  for (std::size_t i = 0; i < points.size(); ++i) {
    places[i].x = points[i];
    if (stop_ != Stop::none || !points[i].allFinite()) continue;
    if (points[i] == accepted_.x && (!want_gradient || accepted_.derivatives)) {
      places[i] = accepted_;
      continue;
    }
    if (!reachable(points[i])) continue;
    if (problem_.evaluations() + static_cast<int>(asked.size()) >= settings_.max_evaluations) {
      stop_ = Stop::evaluations;
      continue;
    }
    asked.push_back(i);
    there.push_back(points[i]);
  }
  if (asked.empty()) return places;
  const std::vector<Trial> trials = problem_.evaluate(there, want_gradient);
  for (std::size_t k = 0; k < asked.size(); ++k) enter(places[asked[k]], trials[k], want_gradient);
  return places;
}

void Walk::accept(const Place& place)
{
  last_ = place;
  accept_last();
}

std::optional<double> Walk::violation(const VectorXd& x)
{
  if (stop_ != Stop::none || !x.allFinite()) return std::nullopt;
  blocked_ = !reachable(x);
  if (blocked_) return std::nullopt;
  const VectorXd c = problem_.constraints(x);
  if (!c.allFinite()) return std::nullopt;
  return largest_violation(c, problem_.equality_count());
}

bool Walk::reachable(const VectorXd& x)
{
  const VectorXd d = problem_.step_between(accepted_.x, x);
  // A line search that comes nearer on a ray need not ask again while it is still too far.
  if (direction_.size() > 0) {
    const double part = d.dot(direction_) / direction_.squaredNorm();
    const double off = (d - part * direction_).cwiseAbs().maxCoeff();
    const double size = std::max(1.0, problem_.scaled(x).cwiseAbs().maxCoeff());
    if (off <= rounding * size && part > safe_ && part <= 1.0) return false;
    if (d == direction_) return safe_ >= 1.0;
  }
  safe_ = problem_.largest_safe_step(accepted_.x, d);
  direction_ = d.squaredNorm() > 0.0 ? d : VectorXd();
  return safe_ >= 1.0;
}

void Walk::evaluate(Place& place, bool want_gradient)
{
  enter(place, problem_.evaluate(place.x, want_gradient), want_gradient);
}

void Walk::enter(Place& place, const Trial& trial, bool want_gradient)
{
  if (!trial.ok) return;
  place.value = trial.value;
  place.at.gradient = trial.gradient;
  place.derivatives = want_gradient;
  problem_.linearise(place.x, place.at);
  place.ok = place.at.c.allFinite() && place.at.J.allFinite();
}

void Walk::accept_last()
{
  const VectorXd step = problem_.step_between(accepted_.x, last_.x);
  Trial known;
  known.value = last_.value;
  if (last_.derivatives) known.gradient = last_.at.gradient;
  known = problem_.accept(last_.x, known);
  best_.looked_again(last_.value, known.value);
  accepted_ = last_;
  accepted_.value = known.value;
  if (last_.derivatives) accepted_.at.gradient = known.gradient;
  direction_.resize(0);
  if (best_.offer(accepted_.x, accepted_.value, largest_violation(accepted_.at))) best_place_ = accepted_;
  ++iteration_;
  report(step.size() == 0 ? 0.0 : step.cwiseAbs().maxCoeff());
}

Step Walk::descent(const Place& place) const
{
  return steepest_step(place.at, problem_.step_lower(place.x), problem_.step_upper(place.x), 0.0);
}

void Walk::report(double step)
{
  OptimizerIterate iterate;
  iterate.iteration = iteration_;
  iterate.value = accepted_.value;
  iterate.step = step;
  iterate.constraint_violation = largest_violation(accepted_.at);
  iterate.optimality = std::numeric_limits<double>::quiet_NaN();
  iterate.x = {accepted_.x.data(), static_cast<std::size_t>(accepted_.x.size())};
  multipliers_.resize(0);
  if (accepted_.derivatives) {
    const Step down = descent(accepted_);
    if (down.ok) multipliers_ = down.multipliers;
    if (down.ok)
      iterate.optimality = optimality(down, accepted_.at.J, problem_.step_lower(accepted_.x),
                                      problem_.step_upper(accepted_.x));
  }
  if (!observer_.on_iterate(iterate))
    stop_ = Stop::observer;
  else if (iteration_ >= settings_.max_iterations)
    stop_ = Stop::iterations;
}

void Walk::restore()
{
  const auto violated = [this] { return largest_violation(accepted_.at) > settings_.constraint_tolerance; };
  for (int k = 0; k < most_restorations && violated() && stop_ == Stop::none; ++k) {
    const Step step = nearest_feasible_step(accepted_.at, problem_.step_lower(accepted_.x),
                                            problem_.step_upper(accepted_.x));
    if (!step.ok || step.d.squaredNorm() == 0.0) return;
    const double before = largest_violation(accepted_.at);
    const VectorXd x = problem_.moved(accepted_.x, step.d, 1.0);
    const Place& there = look(x, accepted_.derivatives);
    if (!there.ok || !(largest_violation(there.at) < before)) return;
    accept_last();
  }
}

void Walk::return_to_best()
{
  if (!best_.any() || best_.x() == accepted_.x) return;
  const bool want_gradient = accepted_.derivatives;
  if (look(best_.x(), want_gradient).ok) accept_last();
}

void Walk::differentiate()
{
  if (best_place_.derivatives || stop_ != Stop::none) return;
  const Trial trial = problem_.evaluate(best_place_.x, true);
  if (!trial.ok) return;
  best_place_.at.gradient = trial.gradient;
  best_place_.derivatives = true;
}

bool Walk::critical() const
{
  if (!best_.feasible() || !best_place_.derivatives) return false;
  const Step step = descent(best_place_);
  return step.ok && optimality(step, best_place_.at.J, problem_.step_lower(best_place_.x),
                               problem_.step_upper(best_place_.x)) <=
                        std::sqrt(settings_.tolerance) * objective_scale(first_value_, best_place_.value);
}

bool Walk::infeasible() const
{
  if (best_.feasible()) return false;
  Linearisation at = best_place_.at;
  if (at.gradient.size() == 0) at.gradient = VectorXd::Zero(problem_.size());
  const Step step =
      steepest_step(at, problem_.step_lower(best_place_.x), problem_.step_upper(best_place_.x), 0.0);
  return step.ok && locally_infeasible(step, at, settings_.constraint_tolerance);
}

OptimizerResult Walk::finish(std::string status, std::string message) const
{
  OptimizerResult result = best_.result(std::move(status), std::move(message), accepted_.x, accepted_.value);
  result.iterations = iteration_;
  result.evaluations = problem_.evaluations();
  return result;
}

OptimizerResult Walk::finish_stopped() const
{
  switch (stop_) {
    case Stop::observer:
      return finish("stopped", "stopped on request");
    case Stop::iterations:
      return finish("iteration_limit",
                    "stopped after " + std::to_string(settings_.max_iterations) + " iterations");
    default:
      return finish("iteration_limit",
                    "stopped after " + std::to_string(settings_.max_evaluations) + " evaluations");
  }
}

}  // namespace hauberk
