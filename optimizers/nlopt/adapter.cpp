#include "adapter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The penalty exceeds the multipliers, for which the merit function is exact, by this factor.
constexpr double penalty_margin = 1.5;
/// Steps onto the constraints; each is one of Newton's method.
constexpr int most_restorations = 5;
/// So many points in a row that are not evaluated end a run of NLopt: mma and ccsaq would ask for them for
/// ever, as no model explains a wall.
constexpr int most_walls = 100;

}  // namespace

NloptAdapter::NloptAdapter(OptimizationProblem& problem, const NloptSettings& settings,
                           OptimizerObserver& observer, std::span<const double> start)
    : problem_(problem, start), settings_(settings), observer_(observer), best_(settings.constraint_tolerance)
{
  accepted_.x = Eigen::Map<const VectorXd>(start.data(), static_cast<Index>(start.size()));
}

bool NloptAdapter::begin(std::string& why)
{
  const bool gradients = settings_.algorithm != NloptAlgorithm::cobyla;
  const Trial trial = problem_.begin(accepted_.x, accepted_.at, gradients);
  accepted_.value = first_value_ = worst_ = trial.value;
  why = trial.why;
  if (!trial.ok) return false;
  unit_ = objective_scale(first_value_, first_value_);
  accepted_.ok = true;
  accepted_.derivatives = gradients;
  best_.offer(accepted_.x, accepted_.value, largest_violation(accepted_.at.c));
  best_point_ = last_ = accepted_;
  if (!report(accepted_, 0.0)) stop(Stop::observer);
  if (stop_ == Stop::none && settings_.max_iterations == 0) stop(Stop::iterations);
  return true;
}

const NloptAdapter::Point& NloptAdapter::look(const double* z, bool want_gradient)
{
  const Eigen::Map<const VectorXd> scaled(z, size());
  const VectorXd x = scaled.allFinite() ? problem_.unscaled(scaled) : VectorXd(scaled);
  if (stop_ == Stop::none && ++walls_ > most_walls) stop(Stop::walls);
  const auto known = [&](const Point& p) { return p.x == x && (!want_gradient || p.derivatives || !p.ok); };
  if (known(accepted_)) return accepted_;
  if (known(last_)) return last_;
  last_ = {};
  last_.x = x;
  if (stop_ != Stop::none || !x.allFinite()) return last_;
  if (problem_.evaluations() >= settings_.max_evaluations) {
    stop(Stop::evaluations);
    return last_;
  }
  evaluate(last_, want_gradient);
  if (last_.ok) consider(last_);
  return last_;
}

void NloptAdapter::evaluate(Point& p, bool want_gradient)
{
  blocked_ = problem_.largest_safe_step(accepted_.x, problem_.step_between(accepted_.x, p.x)) < 1.0;
  if (blocked_) return;
  const Trial trial = problem_.evaluate(p.x, want_gradient);
  walls_ = 0;
  if (!trial.ok) return;
  p.value = trial.value;
  p.at.gradient = trial.gradient;
  p.derivatives = want_gradient;
  problem_.linearise(p.x, p.at);
  p.ok = p.at.c.allFinite() && p.at.J.allFinite();
  if (p.ok) worst_ = std::max(worst_, p.value);
}

void NloptAdapter::consider(const Point& p)
{
  const double violation = largest_violation(p.at.c);
  const bool best = best_.improved_by(p.value, violation);
  if (!best && !(merit(p) < merit(accepted_))) return;
  const VectorXd step = problem_.step_between(accepted_.x, p.x);
  Trial known;
  known.value = p.value;
  if (p.derivatives) known.gradient = p.at.gradient;
  known = problem_.accept(p.x, known);
  if (known.value > p.value + surprise * std::abs(p.value)) best_.forget();
  accepted_ = p;
  accepted_.value = known.value;
  if (p.derivatives) accepted_.at.gradient = known.gradient;
  if (best_.offer(p.x, accepted_.value, violation)) best_point_ = accepted_;
  ++iteration_;
  if (!report(accepted_, step.size() == 0 ? 0.0 : step.cwiseAbs().maxCoeff()))
    stop(Stop::observer);
  else if (iteration_ >= settings_.max_iterations)
    stop(Stop::iterations);
}

Step NloptAdapter::descent(const Point& p) const
{
  return steepest_step(p.at, problem_.step_lower(p.x), problem_.step_upper(p.x), penalty_);
}

bool NloptAdapter::report(const Point& p, double step)
{
  OptimizerIterate iterate;
  iterate.iteration = iteration_;
  iterate.value = p.value;
  iterate.step = step;
  iterate.constraint_violation = largest_violation(p.at.c);
  iterate.optimality = std::numeric_limits<double>::quiet_NaN();
  iterate.x = {p.x.data(), static_cast<std::size_t>(p.x.size())};
  if (p.derivatives) {
    const Step descent = this->descent(p);
    if (descent.ok) {
      iterate.optimality = optimality(descent, p.at.J, problem_.step_lower(p.x), problem_.step_upper(p.x));
      if (descent.multipliers.size() > 0)
        penalty_ = std::max(penalty_, penalty_margin * descent.multipliers.maxCoeff());
    }
  }
  return observer_.on_iterate(iterate);
}

double NloptAdapter::objective(const double* z, double* gradient)
{
  const Point& p = look(z, gradient != nullptr);
  const Index n = size();
  if (p.ok) {
    if (gradient != nullptr) Eigen::Map<VectorXd>(gradient, n) = p.at.gradient / unit_;
    return p.value / unit_;
  }
  if (gradient != nullptr) {
    VectorXd slope = VectorXd::Zero(n);
    const VectorXd d = problem_.step_between(accepted_.x, p.x);
    if (d.allFinite() && d.squaredNorm() > 0.0) slope = d / d.squaredNorm();
    Eigen::Map<VectorXd>(gradient, n) = slope;
  }
  return worst_ / unit_ + 1.0;
}

void NloptAdapter::constraints(const double* z, double* values, double* jacobian)
{
  // Objective and constraints are asked one after the other: whoever comes first evaluates.
  const Point& p = look(z, jacobian != nullptr);
  const Index m = constraint_count(), n = size();
  VectorXd c = accepted_.at.c;
  const MatrixXd* J = &accepted_.at.J;
  if (p.ok && p.at.c.size() == m) {
    c = p.at.c;
    J = &p.at.J;
  } else {
    const VectorXd d = problem_.step_between(accepted_.x, p.x);
    if (d.allFinite()) c += *J * d;
  }
  Eigen::Map<VectorXd>(values, m) = -c;
  if (jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobian, m, n) = -*J;
}

void NloptAdapter::fail(std::exception_ptr exception)
{
  exception_ = std::move(exception);
  stop(Stop::exception);
}

void NloptAdapter::rethrow() const
{
  if (exception_) std::rethrow_exception(exception_);
}

void NloptAdapter::restore()
{
  const auto violated = [this] { return largest_violation(accepted_.at.c) > settings_.constraint_tolerance; };
  for (int k = 0; k < most_restorations && violated() && stop_ == Stop::none; ++k) {
    const Step step = nearest_feasible_step(accepted_.at, problem_.step_lower(accepted_.x),
                                            problem_.step_upper(accepted_.x));
    if (!step.ok || step.d.squaredNorm() == 0.0) return;
    const VectorXd before = accepted_.x;
    const VectorXd z = problem_.scaled(problem_.moved(accepted_.x, step.d, 1.0));
    look(z.data(), accepted_.derivatives);
    if (accepted_.x == before) return;
  }
}

void NloptAdapter::differentiate()
{
  if (best_point_.derivatives || stop_ != Stop::none) return;
  const Trial trial = problem_.evaluate(best_point_.x, true);
  if (!trial.ok) return;
  best_point_.at.gradient = trial.gradient;
  best_point_.derivatives = true;
}

bool NloptAdapter::critical() const
{
  if (!best_.feasible() || !best_point_.derivatives) return false;
  const Step step = descent(best_point_);
  return step.ok && optimality(step, best_point_.at.J, problem_.step_lower(best_point_.x),
                               problem_.step_upper(best_point_.x)) <=
                        std::sqrt(settings_.tolerance) * objective_scale(first_value_, best_point_.value);
}

bool NloptAdapter::infeasible() const
{
  if (best_.feasible()) return false;
  Linearisation at = best_point_.at;
  if (at.gradient.size() == 0) at.gradient = VectorXd::Zero(size());
  const Step step =
      steepest_step(at, problem_.step_lower(best_point_.x), problem_.step_upper(best_point_.x), penalty_);
  return step.ok && locally_infeasible(step, at.c, settings_.constraint_tolerance);
}

OptimizerResult NloptAdapter::finish(std::string status, std::string message) const
{
  OptimizerResult result = best_.result(std::move(status), std::move(message), accepted_.x, accepted_.value);
  result.iterations = iteration_;
  result.evaluations = problem_.evaluations();
  return result;
}

}  // namespace hauberk
