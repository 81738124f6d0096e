#include "minimizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hauberk {
namespace {

using Eigen::VectorXd;

/// Accepted steps in a row that gain less than the tolerance before the run counts as stalled.
constexpr int slow_limit = 3;
/// A restart paid off when the objective or the violation fell by these parts since.
constexpr double worthwhile_value = 1e-2;
constexpr double worthwhile_violation = 0.5;
/// Shift above which a model that promises nothing says nothing.
constexpr double held = 1.0;
/// Shift when the cuts of a bundle are dropped.
constexpr double restart_shift = 1e-2;
}  // namespace

Minimizer::Minimizer(OptimizationProblem& problem, const SqpSettings& settings, OptimizerObserver& observer,
                     std::span<const double> start)
    : problem_(problem, start),
      settings_(settings),
      observer_(observer),
      x_(Eigen::Map<const VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()))),
      best_(settings.constraint_tolerance)
{
}

OptimizerResult Minimizer::run()
{
  std::string why;
  if (!begin(why)) return finish("failed", "the start cannot be evaluated: " + why);
  for (;;) {
    const Step step = propose(at_);
    if (!step.ok) {
      if (restart()) continue;
      return finish("failed", "the quadratic model has no solution; gradients or constraints are not finite");
    }
    if (!report(step)) return finish("stopped", "stopped on request");
    if (converged(step)) return finish("converged", "no step promises a noticeable decrease");
    if (locally_infeasible(step, at_, settings_.constraint_tolerance)) {
      return finish("infeasible", "no small step reduces the violation of the constraints");
    }
    if (iteration_ >= settings_.max_iterations) {
      return finish("iteration_limit", "stopped after " + std::to_string(iteration_) + " iterations");
    }
    if (spent()) {
      return finish("iteration_limit",
                    "stopped after " + std::to_string(problem_.evaluations()) + " evaluations");
    }
    raise_penalty(step);
    if (slow_steps_ < slow_limit && (least_squares() ? bundle_search(step) : line_search(step))) {
      ++iteration_;
      continue;
    }
    if (spent() || restart()) continue;
    return finish("small_step", blocked_ ? "the next step would pass through an intersection"
                                         : "steps became too small to make progress");
  }
}

bool Minimizer::begin(std::string& why)
{
  const Trial trial = problem_.begin(x_, at_);
  value_ = first_value_ = trial.value;
  why = trial.why;
  if (!trial.ok) return false;
  remember();
  reset_hessian(settings_.initial_step);
  refresh_bundle();
  return true;
}

void Minimizer::refresh_bundle()
{
  if (!settings_.gauss_newton) return;
  Residuals at = problem_.residuals(x_);
  if (at.empty())
    bundle_.clear();
  else
    bundle_.move(problem_.scaled(x_), std::move(at));
}

Step Minimizer::propose(const Linearisation& at) const
{
  // The first curvature of BFGS holds its first step short; a Gauss-Newton step may be as long as it likes.
  const double longest = least_squares() && iteration_ == 0 ? settings_.initial_step : settings_.max_step;
  const VectorXd lower = problem_.step_lower(x_).cwiseMax(-longest);
  const VectorXd upper = problem_.step_upper(x_).cwiseMin(longest);
  if (least_squares()) return bundle_.propose(at, lower, upper, damping_, penalty_);
  return propose_step(hessian_.matrix(), at, lower, upper, penalty_);
}

double Minimizer::optimality(const Step& step) const
{
  return hauberk::optimality(step, at_.J, problem_.step_lower(x_), problem_.step_upper(x_));
}

bool Minimizer::converged(const Step& step) const
{
  if (largest_violation(at_) > settings_.constraint_tolerance) return false;
  // A gradient g promises g^2/(2 H); with H of the objective's size in scaled variables, the square root
  // makes both conditions ask for the same.
  const double scale = this->scale();
  if (least_squares() && damping_ > held) return false;  // the shift alone makes the promise small
  const bool no_step = step.d.size() == 0 || step.d.cwiseAbs().maxCoeff() < settings_.min_step;
  return (step.decrease <= settings_.tolerance * scale || no_step) &&
         optimality(step) <= std::sqrt(settings_.tolerance) * scale;
}

bool Minimizer::report(const Step& step)
{
  if (reported_) return true;
  reported_ = true;
  OptimizerIterate iterate;
  iterate.iteration = iteration_;
  iterate.value = value_;
  iterate.step = step_length_;
  iterate.constraint_violation = largest_violation(at_);
  iterate.optimality = optimality(step);
  iterate.x = {x_.data(), static_cast<std::size_t>(x_.size())};
  return observer_.on_iterate(iterate);
}

void Minimizer::reset_hessian(double radius)
{
  // The first step is then at most about `radius` long in every scaled variable.
  const double steepest = at_.gradient.size() == 0 ? 0.0 : at_.gradient.cwiseAbs().maxCoeff();
  hessian_.reset(x_.size(), steepest > 0.0 ? steepest / radius : 1.0);
}

bool Minimizer::restart()
{
  const bool again = least_squares() ? dropped_ : hessian_.fresh();  // would propose the same step
  if (again) return false;
  if (restarted_) {
    const bool better = value_ < restart_value_ - worthwhile_value * std::abs(restart_value_);
    const bool more_feasible = total_violation(at_) < worthwhile_violation * restart_violation_;
    if (!better && !more_feasible) return false;
  }
  restarted_ = true;
  restart_value_ = value_;
  restart_violation_ = total_violation(at_);
  slow_steps_ = 0;
  if (least_squares()) {  // cuts of a residual that is not convex may be in the way
    dropped_ = true;
    bundle_.drop_cuts();
    damping_ = restart_shift;
  } else {
    reset_hessian(std::clamp(step_length_, 10.0 * settings_.min_step, settings_.initial_step));
  }
  return true;
}

void Minimizer::move_to(const VectorXd& x, const Trial& tried, const VectorXd& s, const Step& step)
{
  const Trial trial = problem_.accept(x, tried);
  best_.looked_again(tried.value, trial.value);
  Linearisation next;
  next.gradient = trial.gradient;
  problem_.linearise(x, next);
  VectorXd y = next.gradient - at_.gradient;
  if (next.c.size() == at_.c.size()) y -= (next.J - at_.J).transpose() * step.multipliers;
  hessian_.update(s, y);
  at_ = std::move(next);
  x_ = x;
  value_ = trial.value;
  refresh_bundle();
  step_length_ = s.size() == 0 ? 0.0 : s.cwiseAbs().maxCoeff();
  reported_ = false;
  dropped_ = false;
  remember();
}

OptimizerResult Minimizer::finish(std::string status, std::string message) const
{
  if (status == "converged" && best_.value() < value_ - settings_.tolerance * scale()) {
    status = "small_step";
    message =
        "the result is an earlier iterate: the search stepped across a jump and ended further from the "
        "minimum";
  }
  OptimizerResult result = best_.result(std::move(status), std::move(message), x_, value_);
  result.iterations = iteration_;
  result.evaluations = problem_.evaluations();
  return result;
}

}  // namespace hauberk
