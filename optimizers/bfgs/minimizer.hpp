#pragma once
/// One run of projected BFGS with an augmented Lagrangian.

#include "limited_memory.hpp"

#include <hauberk/optimizer.hpp>

#include <common/best_point.hpp>
#include <common/criticality.hpp>
#include <common/scaled_problem.hpp>
#include <common/search_settings.hpp>

#include <span>
#include <string>

namespace hauberk {

struct BfgsSettings : SearchSettings {
  BfgsSettings() { max_iterations = 200; }
  std::size_t memory = 20;  ///< latest steps that shape the Hessian; 0: all
};

/// Minimises one problem once. Not thread safe; runs on different problems do not share anything.
///
/// The augmented Lagrangian of c >= 0 with multipliers l >= 0 and weight w (Powell, Hestenes, Rockafellar):
///   A(x) = f(x) + sum_i (max(0, l_i - w c_i(x))^2 - l_i^2)/(2 w),
///   grad A = grad f - J^T max(0, l - w c),
/// and of equations c = 0 the same without the maximum, with l of either sign.
class BfgsMinimizer {
 public:
  BfgsMinimizer(OptimizationProblem& problem, const BfgsSettings& settings, OptimizerObserver& observer,
                std::span<const double> start);

  OptimizerResult run();

 private:
  enum class Search { moved, failed, spent };

  bool begin(std::string& why);
  void begin_multipliers();
  /// max(0, l - w c), of equations l - w c: multipliers that c stands for.
  Eigen::VectorXd implied(const Eigen::VectorXd& c) const;
  /// The constraints' part of A.
  double constraint_part(const Eigen::VectorXd& c) const;
  Eigen::VectorXd gradient() const { return at_.gradient - at_.J.transpose() * implied(at_.c); }
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;
  /// What the model of f and all constraints promises: the measure of convergence, not a step to take.
  Step conditions() const;
  /// The conditions of first order hold, but for the violation of constraints.
  bool critical(const Step& conditions) const;
  /// Room times gradient of the bound-constrained problem min A.
  double inner_optimality() const;
  bool report(const Step& conditions);
  /// One step that lowers A.
  Search search();
  void move_to(const Eigen::VectorXd& x, const Trial& tried, const Eigen::VectorXd& s);
  /// One step onto the linearised constraints, as A is least slightly beyond them. Costs an evaluation; false
  /// where it does not reduce the violation.
  bool restore();
  /// New multipliers, those of the quadratic model where it is feasible, and a new weight where the violation
  /// does not fall. False when that changes nothing.
  bool update_multipliers(const Step& conditions);
  /// The sum of squares of the violations is stationary.
  bool infeasible() const;
  bool restart();
  void reset_hessian(double radius);
  bool feasible() const { return largest_violation(at_) <= settings_.constraint_tolerance; }
  bool spent() const { return problem_.evaluations() >= settings_.max_evaluations; }
  double scale() const { return objective_scale(first_value_, value_); }
  OptimizerResult finish(std::string status, std::string message) const;

  ScaledProblem problem_;
  BfgsSettings settings_;
  OptimizerObserver& observer_;

  Eigen::VectorXd x_;
  double value_ = 0.0;
  double first_value_ = 0.0;
  Linearisation at_;
  LimitedMemory hessian_;  ///< of the Lagrangian; the penalty's part is known
  BestPoint best_;

  Eigen::VectorXd multipliers_;
  double weight_ = 1.0;
  double heaviest_ = 1.0;         ///< weight that is not exceeded
  double inner_tolerance_ = 0.0;  ///< of A, in the objective's unit
  double last_violation_ = 0.0;  ///< of constraints or complementarity when the multipliers were updated last
  int restorations_ = 0;         ///< in a row
  int idle_updates_ = 0;         ///< of the multipliers without a step between

  int iteration_ = 0;
  double step_length_ = 0.0;
  bool reported_ = false;
  int slow_steps_ = 0;
  bool blocked_ = false;  ///< the last search was stopped by an intersection
  bool restarted_ = false;
  double restart_value_ = 0.0;
  double restart_violation_ = 0.0;
};

}  // namespace hauberk
