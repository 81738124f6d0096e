/// The globalisation of Minimizer: l1 merit function, backtracking from the largest safe step (or, with
/// residuals, a bundle that learns from failed trials) and a second-order correction (Nocedal and Wright,
/// Numerical Optimization, 2nd ed., sections 15.4 and 18.3).

#include "minimizer.hpp"

#include <common/backtracking.hpp>

#include <algorithm>

namespace hauberk {
namespace {

using Eigen::VectorXd;

/// Part of what the model promises that a step of the bundle must bring: its model knows kinks.
constexpr double sufficient_of_model = 0.1;
/// The shift falls after a first trial that was accepted at full length; it rises after one that showed a
/// kink, one that showed only curvature, and one that failed.
constexpr double shift_fall = 0.4;
constexpr double shift_rise_kink = 1.5;
constexpr double shift_rise = 4.0;
constexpr double shift_rise_failure = 16.0;
constexpr double least_shift = 1e-6;
constexpr double largest_shift = 1e9;
/// A trial that rises by this many times the promised decrease, with nothing new to see, is beyond a jump.
constexpr double jump = 3.0;
/// So many steps in a row that each gain less than this part of the objective creep along it. Then one step
/// across is tried, with this shift, that may raise the objective by this part; so often in a run.
constexpr int creeping_limit = 2;
constexpr double creeping_gain = 3e-3;
constexpr double crossing_shift = 1e-2;
constexpr double crossing_rise = 0.25;
constexpr int most_crossings = 8;
/// The penalty exceeds the multipliers, for which the merit function is exact, by this factor.
constexpr double penalty_margin = 1.5;
/// Part of the penalised decrease of the violation that the objective's increase may use up.
constexpr double usable = 0.5;
/// A correction has to remove this part of the violation, and may not be longer than this part of the step.
constexpr double correction_gain = 0.5;
constexpr double correction_length = 0.5;

}  // namespace

void Minimizer::raise_penalty(const Step& step)
{
  if (at_.c.size() == 0) return;
  const double target = penalty_margin * step.multipliers.cwiseAbs().maxCoeff();
  // It may come down again, slowly: a penalty that stays too large follows the constraints in tiny steps.
  penalty_ = std::max(target, 0.5 * (penalty_ + target));
  const double removed = total_violation(at_) - step.model_violation;
  if (removed > 0.0) penalty_ = std::max(penalty_, -step.decrease / (usable * removed));
}

bool Minimizer::line_search(const Step& step)
{
  const double slope = this->slope(step);
  const double length = step.d.size() == 0 ? 0.0 : step.d.cwiseAbs().maxCoeff();
  double alpha = problem_.largest_safe_step(x_, step.d);
  blocked_ = alpha * length < settings_.min_step && length >= settings_.min_step;
  if (!(slope < 0.0)) return false;

  const double before = merit(value_, at_.c);
  for (int trial = 0; trial < max_trials && alpha * length >= settings_.min_step && !spent(); ++trial) {
    VectorXd d = alpha * step.d;
    VectorXd x = problem_.moved(x_, d, 1.0);
    VectorXd c = problem_.constraints(x);
    if (trial == 0 && alpha == 1.0 && c.allFinite() && correct(step, d, c)) x = problem_.moved(x_, d, 1.0);
    const Trial found = problem_.evaluate(x);
    if (!found.ok || !c.allFinite()) {
      alpha *= failure_cut;
      continue;
    }
    const double rise = merit(found.value, c) - before;
    if (rise <= sufficient_decrease * alpha * slope) {
      slow_steps_ = -rise <= settings_.tolerance * scale() ? slow_steps_ + 1 : 0;
      move_to(x, found, d, step);
      return true;
    }
    alpha = shorter(alpha, slope, rise);
  }
  return false;
}

bool Minimizer::bundle_search(Step step)
{
  blocked_ = false;
  // Where a residual jumps, the search creeps along the edge of the jump. Then a step across it is taken even
  // if the objective is higher there; the best iterate is remembered.
  bool across = jumped_ && creeping_ >= creeping_limit && crossings_ < most_crossings;
  if (across) {
    ++crossings_;
    creeping_ = 0;
    jumped_ = false;
    const double shift = damping_;
    bundle_.drop_cuts();
    damping_ = crossing_shift;
    const Step longer = propose(at_);
    across = longer.ok && slope(longer) < 0.0 && longer.d.cwiseAbs().maxCoeff() >= settings_.min_step;
    if (across)
      step = longer;
    else
      damping_ = shift;
  }
  for (int trial = 0; trial < max_trials && step.ok && !spent(); ++trial) {
    if (trial > 0) {  // within a search the penalty only rises
      const double penalty = penalty_;
      raise_penalty(step);
      penalty_ = std::max(penalty_, penalty);
    }
    const double before = merit(value_, at_.c);
    const double slope = this->slope(step);
    const double length = step.d.size() == 0 ? 0.0 : step.d.cwiseAbs().maxCoeff();
    if (!(slope < 0.0) || length < settings_.min_step) return false;
    const double alpha = problem_.largest_safe_step(x_, step.d);
    blocked_ = alpha * length < settings_.min_step;
    double rise_of_shift = shift_rise_failure;
    if (!blocked_) {
      VectorXd d = alpha * step.d;
      VectorXd x = problem_.moved(x_, d, 1.0);
      VectorXd c = problem_.constraints(x);
      if (alpha == 1.0 && c.allFinite() && correct(step, d, c)) x = problem_.moved(x_, d, 1.0);
      const Trial found = problem_.evaluate(x);
      if (found.ok && c.allFinite()) {
        const double rise = merit(found.value, c) - before;
        if (rise <= sufficient_of_model * alpha * slope || (across && rise <= crossing_rise * value_)) {
          creeping_ = -rise <= creeping_gain * value_ && !across ? creeping_ + 1 : 0;
          slow_steps_ = -rise <= settings_.tolerance * scale() ? slow_steps_ + 1 : 0;
          if (trial == 0 && alpha == 1.0) damping_ = std::max(shift_fall * damping_, least_shift);
          move_to(x, found, d, step);
          return true;
        }
        const bool kink = bundle_.add(problem_.scaled(x), problem_.residuals(x));
        rise_of_shift = kink ? shift_rise_kink : shift_rise;
        jumped_ = jumped_ || (!kink && rise > jump * -slope);
      }
    }
    damping_ = std::min(rise_of_shift * damping_, largest_shift);
    step = propose(at_);
  }
  return false;
}

bool Minimizer::correct(const Step& step, VectorXd& d, VectorXd& c)
{
  // Constraints curve away from their linearisation. Their values at the end of the step tell by how much;
  // solving the model again with that difference costs no evaluation of the objective.
  const double violation = total_violation(c, at_.equalities);
  if (step.elastic || largest_violation(c, at_.equalities) <= settings_.constraint_tolerance) return false;
  Linearisation curved = at_;
  curved.c = c - at_.J * d;
  const Step corrected = propose(curved);
  if (!corrected.ok || corrected.elastic) return false;
  if ((corrected.d - d).norm() > correction_length * d.norm()) return false;
  if (problem_.largest_safe_step(x_, corrected.d) < 1.0) return false;
  const VectorXd c_corrected = problem_.constraints(problem_.moved(x_, corrected.d, 1.0));
  if (!c_corrected.allFinite() || total_violation(c_corrected, at_.equalities) > correction_gain * violation)
    return false;
  d = corrected.d;
  c = c_corrected;
  return true;
}

}  // namespace hauberk
