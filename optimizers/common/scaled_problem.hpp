#pragma once
/// A kernel problem in variables scaled by their ranges, with checked values and counted calls.

#include "point.hpp"

#include <hauberk/optimizer.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace hauberk {

/// x = scale * z, component-wise, with scale = upper - lower (where that is 0 or infinite, max(1, |start|)),
/// so that a step of 1 crosses a variable's range. Points are kept in x, which alone goes to the problem;
/// steps and derivatives are scaled.
class ScaledProblem {
 public:
  ScaledProblem(OptimizationProblem& problem, std::span<const double> start);

  Eigen::Index size() const { return scale_.size(); }

  /// Bounds of a scaled step from x.
  Eigen::VectorXd step_lower(const Eigen::VectorXd& x) const { return (lower_ - x).cwiseQuotient(scale_); }
  Eigen::VectorXd step_upper(const Eigen::VectorXd& x) const { return (upper_ - x).cwiseQuotient(scale_); }
  /// x + alpha scale d, within the bounds.
  Eigen::VectorXd moved(const Eigen::VectorXd& x, const Eigen::VectorXd& d, double alpha) const;

  /// Value and gradient together: the gradient costs hardly more, and nearly every accepted point needs it.
  Trial evaluate(const Eigen::VectorXd& x, bool want_gradient = true);
  /// The same of several points, in their order, as a batch.
  std::vector<Trial> evaluate(const std::vector<Eigen::VectorXd>& points, bool want_gradient);
  Eigen::VectorXd constraints(const Eigen::VectorXd& x);
  /// Fills all but the gradient.
  void linearise(const Eigen::VectorXd& x, Linearisation& at);
  /// Evaluates and accepts the start and fills `at`. Where something cannot be had, the trial is not ok and
  /// says why.
  Trial begin(const Eigen::VectorXd& start, Linearisation& at, bool want_gradient = true);
  /// Residuals at the point evaluated last; empty when the problem has none.
  Residuals residuals(const Eigen::VectorXd& x);
  /// The Hessian of weight f - multipliers . c at the accepted point x in scaled variables, from as many
  /// products as there are variables; false where it is not known.
  bool hessian(const Eigen::VectorXd& x, double weight, const Eigen::VectorXd& multipliers,
               Eigen::MatrixXd& H);
  /// x in scaled variables: differences of these are scaled steps.
  Eigen::VectorXd scaled(const Eigen::VectorXd& x) const { return x.cwiseQuotient(scale_); }
  /// The point of scaled variables z, within the bounds.
  Eigen::VectorXd unscaled(const Eigen::VectorXd& z) const
  {
    return z.cwiseProduct(scale_).cwiseMax(lower_).cwiseMin(upper_);
  }
  /// The scaled step from one point to another.
  Eigen::VectorXd step_between(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const
  {
    return (to - from).cwiseQuotient(scale_);
  }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  int constraint_count() const { return problem_.constraint_count(); }
  int equality_count() const { return problem_.equality_count(); }
  std::uint64_t stream() const { return problem_.stream(); }
  /// In [0, 1].
  double largest_safe_step(const Eigen::VectorXd& x, const Eigen::VectorXd& d);
  /// Makes x, just evaluated as `trial`, the iterate; returns what is known of it then, which a closer look
  /// may have changed.
  Trial accept(const Eigen::VectorXd& x, const Trial& trial);

  int evaluations() const { return evaluations_; }

 private:
  /// An evaluation whose numbers are all finite, in scaled variables; else not ok, and why.
  Trial checked(OptimizationProblem::Evaluation evaluation, bool want_gradient) const;

  OptimizationProblem& problem_;
  Eigen::VectorXd lower_, upper_, scale_;
  int evaluations_ = 0;
};

}  // namespace hauberk
