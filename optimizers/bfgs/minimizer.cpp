#include "minimizer.hpp"

#include <common/backtracking.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The first weight makes the penalty of a violation met within this part of the ranges as steep as f.
constexpr double first_reach = 0.1;
/// The weight rises by this factor unless the violation fell to this part, and at most so far.
constexpr double weight_rise = 10.0;
constexpr double wanted_fall = 0.25;
constexpr double most_weight = 1e10;
/// Accuracy of the first minimisation of A, relative to the objective, and how it tightens.
constexpr double first_inner = 0.1;
constexpr double inner_fall = 0.1;
/// The last one, as part of what convergence asks for.
constexpr double last_inner = 0.1;
/// Updates of the multipliers in a row that no step followed.
constexpr int most_idle_updates = 12;
/// A violation is stationary when a step within the room promises to remove less than this part of it.
constexpr double stationary = 1e-3;
/// Accepted steps in a row without noticeable decrease of A before the multipliers are updated.
constexpr int slow_limit = 3;
/// Steps onto the constraints in a row; each is one of Newton's method.
constexpr int most_restorations = 5;
/// Trials that the constraints alone rule out; they cost no evaluation of the objective.
constexpr int most_ruled_out = 30;
/// A restart paid off when the objective or the violation fell by these parts since.
constexpr double worthwhile_value = 1e-2;
constexpr double worthwhile_violation = 0.5;

}  // namespace

BfgsMinimizer::BfgsMinimizer(OptimizationProblem& problem, const BfgsSettings& settings,
                             OptimizerObserver& observer, std::span<const double> start)
    : problem_(problem, start),
      settings_(settings),
      observer_(observer),
      x_(Eigen::Map<const VectorXd>(start.data(), static_cast<Index>(start.size()))),
      hessian_(settings.memory),
      best_(settings.constraint_tolerance)
{
}

OptimizerResult BfgsMinimizer::run()
{
  std::string why;
  if (!begin(why)) return finish("failed", "the start cannot be evaluated: " + why);
  for (;;) {
    const Step conditions = this->conditions();
    if (!conditions.ok)
      return finish("failed", "the quadratic model has no solution; gradients or constraints are not finite");
    if (!report(conditions)) return finish("stopped", "stopped on request");
    const bool critical = this->critical(conditions);
    if (critical && feasible()) return finish("converged", "no step promises a noticeable decrease");
    if (iteration_ >= settings_.max_iterations)
      return finish("iteration_limit", "stopped after " + std::to_string(iteration_) + " iterations");
    if (spent())
      return finish("iteration_limit",
                    "stopped after " + std::to_string(problem_.evaluations()) + " evaluations");

    if (critical && restore()) {
      ++iteration_;
      continue;
    }
    const bool constrained = at_.c.size() > 0;
    const bool minimised =
        slow_steps_ >= slow_limit || (constrained && inner_optimality() <= inner_tolerance_);
    Search search = Search::failed;
    if (!minimised) search = this->search();
    if (search == Search::spent) continue;
    if (search == Search::moved) {
      ++iteration_;
      continue;
    }
    if (constrained && infeasible())
      return finish("infeasible", "no small step reduces the violation of the constraints");
    if (constrained && update_multipliers(conditions)) continue;
    if (restart()) continue;
    if (restore()) {
      ++iteration_;
      continue;
    }
    return finish("small_step", blocked_ ? "the next step would pass through an intersection"
                                         : "steps became too small to make progress");
  }
}

bool BfgsMinimizer::begin(std::string& why)
{
  const Trial trial = problem_.begin(x_, at_);
  value_ = first_value_ = trial.value;
  why = trial.why;
  if (!trial.ok) return false;
  best_.offer(x_, value_, largest_violation(at_));
  reset_hessian(settings_.initial_step);
  begin_multipliers();
  return true;
}

void BfgsMinimizer::begin_multipliers()
{
  multipliers_ = VectorXd::Zero(at_.c.size());
  if (at_.c.size() == 0) return;
  const double steepest = at_.gradient.cwiseAbs().maxCoeff();
  const double steepest_constraint = at_.J.cwiseAbs().maxCoeff();
  if (steepest > 0.0 && steepest_constraint > 0.0)
    weight_ = steepest / (first_reach * steepest_constraint * steepest_constraint);
  heaviest_ = most_weight * weight_;
  // Those of least squares, where the constraints have a common point nearby.
  const Step steepest_step =
      hauberk::steepest_step(at_, problem_.step_lower(x_), problem_.step_upper(x_), 0.0);
  if (steepest_step.ok && !steepest_step.elastic) multipliers_ = steepest_step.multipliers;
  inner_tolerance_ = first_inner * scale();
  last_violation_ = std::numeric_limits<double>::infinity();
}

VectorXd BfgsMinimizer::implied(const VectorXd& c) const
{
  VectorXd out = multipliers_ - weight_ * c;
  for (Index i = at_.equalities; i < out.size(); ++i) out[i] = std::max(out[i], 0.0);
  return out;
}

double BfgsMinimizer::constraint_part(const VectorXd& c) const
{
  return (implied(c).squaredNorm() - multipliers_.squaredNorm()) / (2.0 * weight_);
}

VectorXd BfgsMinimizer::lower() const { return problem_.step_lower(x_).cwiseMax(-settings_.max_step); }

VectorXd BfgsMinimizer::upper() const { return problem_.step_upper(x_).cwiseMin(settings_.max_step); }

Step BfgsMinimizer::conditions() const
{
  return propose_step(hessian_.matrix(), at_, lower(), upper(), implied(at_.c).cwiseAbs().sum());
}

bool BfgsMinimizer::critical(const Step& conditions) const
{
  const bool no_step = conditions.d.size() == 0 || conditions.d.cwiseAbs().maxCoeff() < settings_.min_step;
  return (conditions.decrease <= settings_.tolerance * scale() || no_step) &&
         optimality(conditions, at_.J, problem_.step_lower(x_), problem_.step_upper(x_)) <=
             std::sqrt(settings_.tolerance) * scale();
}

double BfgsMinimizer::inner_optimality() const
{
  Step here;
  here.gradient = at_.gradient;
  here.multipliers = implied(at_.c);
  return optimality(here, at_.J, problem_.step_lower(x_), problem_.step_upper(x_));
}

bool BfgsMinimizer::report(const Step& conditions)
{
  if (reported_) return true;
  reported_ = true;
  OptimizerIterate iterate;
  iterate.iteration = iteration_;
  iterate.value = value_;
  iterate.step = step_length_;
  iterate.constraint_violation = largest_violation(at_);
  iterate.optimality = optimality(conditions, at_.J, problem_.step_lower(x_), problem_.step_upper(x_));
  iterate.x = {x_.data(), static_cast<std::size_t>(x_.size())};
  return observer_.on_iterate(iterate);
}

BfgsMinimizer::Search BfgsMinimizer::search()
{
  // The penalty's Hessian is w J^T J of the constraints that count; BFGS need not learn it.
  const VectorXd implied = this->implied(at_.c);
  MatrixXd H = hessian_.matrix();
  for (Index i = 0; i < implied.size(); ++i) {
    if (i < at_.equalities || implied[i] > 0.0)
      H.noalias() += weight_ * at_.J.row(i).transpose() * at_.J.row(i);
  }
  Linearisation bounds_only;
  bounds_only.gradient = gradient();
  bounds_only.J.resize(0, x_.size());
  const Step step = propose_step(H, bounds_only, lower(), upper(), 0.0);
  blocked_ = false;
  if (!step.ok) return Search::failed;
  const double slope = -step.descent;
  const double length = step.d.size() == 0 ? 0.0 : step.d.cwiseAbs().maxCoeff();
  if (!(slope < 0.0) || length < settings_.min_step) return Search::failed;
  double alpha = problem_.largest_safe_step(x_, step.d);
  blocked_ = alpha * length < settings_.min_step;

  const double before = value_ + constraint_part(at_.c);
  const double slope_of_value = at_.gradient.dot(step.d);
  int ruled_out = 0;
  for (int trial = 0; trial < max_trials && alpha * length >= settings_.min_step;) {
    if (spent()) return Search::spent;
    const VectorXd d = alpha * step.d;
    const VectorXd x = problem_.moved(x_, d, 1.0);
    const VectorXd c = problem_.constraints(x);
    if (!c.allFinite()) {
      ++trial;
      alpha *= failure_cut;
      continue;
    }
    const double part = constraint_part(c);
    const double foreseen = value_ + alpha * slope_of_value + part - before;
    if (foreseen > sufficient_decrease * alpha * slope && ruled_out < most_ruled_out) {
      ++ruled_out;
      alpha = shorter(alpha, slope, foreseen);
      continue;
    }
    ++trial;
    const Trial found = problem_.evaluate(x);
    if (!found.ok) {
      alpha *= failure_cut;
      continue;
    }
    const double rise = found.value + part - before;
    if (rise <= sufficient_decrease * alpha * slope) {
      slow_steps_ = -rise <= settings_.tolerance * scale() ? slow_steps_ + 1 : 0;
      restorations_ = 0;
      move_to(x, found, d);
      return Search::moved;
    }
    alpha = shorter(alpha, slope, rise);
  }
  return Search::failed;
}

bool BfgsMinimizer::restore()
{
  if (feasible() || spent() || restorations_ >= most_restorations) return false;
  ++restorations_;
  const Step step = nearest_feasible_step(at_, lower(), upper());
  if (!step.ok || step.d.squaredNorm() == 0.0) return false;
  if (problem_.largest_safe_step(x_, step.d) < 1.0) return false;
  const VectorXd x = problem_.moved(x_, step.d, 1.0);
  const VectorXd c = problem_.constraints(x);
  if (!c.allFinite() || !(largest_violation(c, at_.equalities) < largest_violation(at_))) return false;
  const Trial found = problem_.evaluate(x);
  if (!found.ok) return false;
  move_to(x, found, step.d);
  return true;
}

void BfgsMinimizer::move_to(const VectorXd& x, const Trial& tried, const VectorXd& s)
{
  const Trial trial = problem_.accept(x, tried);
  best_.looked_again(tried.value, trial.value);
  Linearisation next;
  next.gradient = trial.gradient;
  problem_.linearise(x, next);
  VectorXd y = next.gradient - at_.gradient;
  // Of the Lagrangian with the multipliers that the new point stands for.
  if (next.c.size() == at_.c.size()) y -= (next.J - at_.J).transpose() * implied(next.c);
  hessian_.update(s, y);
  if (next.c.size() != multipliers_.size()) multipliers_ = VectorXd::Zero(next.c.size());
  at_ = std::move(next);
  x_ = x;
  value_ = trial.value;
  step_length_ = s.size() == 0 ? 0.0 : s.cwiseAbs().maxCoeff();
  reported_ = false;
  idle_updates_ = 0;
  best_.offer(x_, value_, largest_violation(at_));
}

bool BfgsMinimizer::update_multipliers(const Step& conditions)
{
  if (++idle_updates_ > most_idle_updates) return false;
  slow_steps_ = 0;
  // Violation, or how far an inequality with a multiplier is from being active.
  VectorXd off = at_.c.cwiseMin(multipliers_ / weight_);
  off.head(at_.equalities) = at_.c.head(at_.equalities);
  const double violation = off.cwiseAbs().maxCoeff();
  multipliers_ = conditions.elastic ? implied(at_.c) : conditions.multipliers;
  if (violation > wanted_fall * last_violation_ && violation > settings_.constraint_tolerance)
    weight_ = std::min(weight_rise * weight_, heaviest_);
  last_violation_ = violation;
  inner_tolerance_ =
      std::max(inner_fall * inner_tolerance_, last_inner * std::sqrt(settings_.tolerance) * scale());
  return true;
}

bool BfgsMinimizer::infeasible() const
{
  if (feasible()) return false;
  Step squares;
  squares.gradient = VectorXd::Zero(x_.size());
  squares.multipliers = (-at_.c).cwiseMax(0.0);
  squares.multipliers.head(at_.equalities) = -at_.c.head(at_.equalities);
  const double promised = optimality(squares, at_.J, problem_.step_lower(x_), problem_.step_upper(x_));
  return promised <= stationary * squares.multipliers.squaredNorm();
}

bool BfgsMinimizer::restart()
{
  if (hessian_.fresh()) return false;  // would propose the same step
  const double violation = total_violation(at_);
  if (restarted_) {
    const bool better = value_ < restart_value_ - worthwhile_value * std::abs(restart_value_);
    const bool more_feasible = violation < worthwhile_violation * restart_violation_;
    if (!better && !more_feasible) return false;
  }
  restarted_ = true;
  restart_value_ = value_;
  restart_violation_ = violation;
  slow_steps_ = idle_updates_ = 0;
  reset_hessian(std::clamp(step_length_, 10.0 * settings_.min_step, settings_.initial_step));
  return true;
}

void BfgsMinimizer::reset_hessian(double radius)
{
  // The first step is then at most about `radius` long in every scaled variable.
  const double steepest = at_.gradient.size() == 0 ? 0.0 : at_.gradient.cwiseAbs().maxCoeff();
  hessian_.reset(x_.size(), steepest > 0.0 ? steepest / radius : 1.0);
}

OptimizerResult BfgsMinimizer::finish(std::string status, std::string message) const
{
  OptimizerResult result = best_.result(std::move(status), std::move(message), x_, value_);
  result.iterations = iteration_;
  result.evaluations = problem_.evaluations();
  return result;
}

}  // namespace hauberk
