#pragma once
/// One run of sequential quadratic programming.

#include "bundle.hpp"
#include "numerics/damped_bfgs.hpp"

#include <hauberk/optimizer.hpp>

#include <common/best_point.hpp>
#include <common/criticality.hpp>
#include <common/scaled_problem.hpp>
#include <common/search_settings.hpp>

#include <span>
#include <string>
#include <vector>

namespace hauberk {

struct SqpSettings : SearchSettings {
  bool gauss_newton = true;  ///< model residuals one by one where the problem has them
};

/// Minimises one problem once. Not thread safe; runs on different problems do not share anything.
class Minimizer {
 public:
  Minimizer(OptimizationProblem& problem, const SqpSettings& settings, OptimizerObserver& observer,
            std::span<const double> start);

  OptimizerResult run();

 private:
  bool begin(std::string& why);
  bool least_squares() const { return !bundle_.empty(); }
  /// Makes x_ the bundle's iterate.
  void refresh_bundle();
  /// The step of the model whose constraints are linearised as in `at`.
  Step propose(const Linearisation& at) const;
  double optimality(const Step& step) const;
  bool converged(const Step& step) const;
  bool report(const Step& step);
  bool restart();
  void raise_penalty(const Step& step);
  /// Of the merit function along the step, to first order.
  double slope(const Step& step) const
  {
    return -step.descent - penalty_ * (total_violation(at_) - step.model_violation);
  }
  bool line_search(const Step& step);
  /// The search for sums of squares: a trial that fails is a cut of the model, which then proposes again.
  bool bundle_search(Step step);
  /// Second-order correction of a full step that ended at constraint values c; false when it does not help.
  bool correct(const Step& step, Eigen::VectorXd& d, Eigen::VectorXd& c);
  void move_to(const Eigen::VectorXd& x, const Trial& tried, const Eigen::VectorXd& s, const Step& step);
  void remember() { best_.offer(x_, value_, largest_violation(at_)); }
  /// No evaluation is left.
  bool spent() const { return problem_.evaluations() >= settings_.max_evaluations; }
  double merit(double value, const Eigen::VectorXd& c) const
  {
    return value + penalty_ * total_violation(c, at_.equalities);
  }
  double scale() const { return objective_scale(first_value_, value_); }
  void reset_hessian(double radius);
  OptimizerResult finish(std::string status, std::string message) const;

  ScaledProblem problem_;
  SqpSettings settings_;
  OptimizerObserver& observer_;

  Eigen::VectorXd x_;
  double value_ = 0.0;
  double first_value_ = 0.0;
  Linearisation at_;
  DampedBfgs hessian_;
  Bundle bundle_;          ///< of residuals; empty: BFGS is used
  double damping_ = 1e-2;  ///< Levenberg-Marquardt shift, relative to the bundle's curvature
  int creeping_ = 0;       ///< steps in a row that gained little
  bool jumped_ = false;    ///< a trial was far higher than promised and no cut explained it
  int crossings_ = 0;      ///< steps taken across jumps
  bool dropped_ = false;   ///< the cuts were dropped and no step was accepted since
  double penalty_ = 0.0;   ///< of the l1 merit function
  BestPoint best_;

  int iteration_ = 0;
  double step_length_ = 0.0;  ///< of the last accepted step
  bool reported_ = false;     ///< the observer knows the current iterate
  int slow_steps_ = 0;        ///< accepted in a row without noticeable decrease
  bool blocked_ = false;      ///< the last line search was stopped by an intersection, not by the objective
  bool restarted_ = false;    ///< the Hessian was reset and nothing came of it yet
  double restart_value_ = 0.0;
  double restart_violation_ = 0.0;
};

}  // namespace hauberk
