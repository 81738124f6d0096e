#pragma once
/// A kernel problem as a library sees it that asks for values anywhere, in an order of its own.

#include "best_point.hpp"
#include "criticality.hpp"
#include "scaled_problem.hpp"

#include <hauberk/optimizer.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

struct WalkSettings {
  int max_iterations = 1000;  ///< accepted points
  int max_evaluations = 100000;
  double tolerance = 1e-6;             ///< of decrease and optimality, relative to the objective
  double constraint_tolerance = 1e-8;  ///< violation that counts as none, in the constraints' unit
};

/// Keeps the contract of `OptimizationProblem`: what is asked for is evaluated only where the straight way
/// from the accepted point is safe. Whoever uses it decides which of the places it has looked at becomes the
/// accepted point; then the observer hears of it. Not thread safe.
class Walk {
 public:
  enum class Stop { none, observer, iterations, evaluations };

  /// A point and what is known of it; derivatives are those of scaled variables.
  struct Place {
    Eigen::VectorXd x;
    bool ok = false;           ///< it can be reached, and everything there is finite
    bool derivatives = false;  ///< the gradient is known
    double value = 0.0;
    Linearisation at;
  };

  Walk(OptimizationProblem& problem, const WalkSettings& settings, OptimizerObserver& observer,
       std::span<const double> start);

  /// Evaluates and accepts the start; false, and why, when that fails.
  bool begin(bool want_gradient, std::string& why);

  /// Value, constraints and, when wanted, gradient at x. The place is valid until the next look. Nothing is
  /// evaluated after a stop, and where the budget of evaluations is spent that is the reason to stop.
  const Place& look(const Eigen::VectorXd& x, bool want_gradient);
  /// The same of several places, all of which are evaluated from the accepted point, as a batch; where the
  /// budget ends, the first ones are, and that is the reason to stop. The accepted point is not
  /// evaluated again.
  std::vector<Place> look(const std::vector<Eigen::VectorXd>& points, bool want_gradient);
  /// Largest violation of the constraints at x, without an evaluation; nothing where x is not on a safe way
  /// or after a stop.
  std::optional<double> violation(const Eigen::VectorXd& x);
  /// Makes the place that was looked at last, which must be ok, the accepted point. It may have another value
  /// then.
  void accept_last();
  /// The same of a place of the last batch.
  void accept(const Place& place);
  /// Whether the place would be the best so far.
  bool improved_by(const Place& place) const
  {
    return best_.improved_by(place.value, largest_violation(place.at));
  }
  double tolerated() const { return settings_.constraint_tolerance; }  ///< violation that counts as none
  /// Moves the accepted point onto the linearised constraints by a few steps of Newton's method, each of
  /// which costs one evaluation.
  void restore();
  /// Makes the best point the accepted one again where the way to it is safe.
  void return_to_best();
  /// Asks for derivatives at the best point, where none are known.
  void differentiate();

  /// The Hessian of weight f - multipliers . c at the accepted point, of scaled variables; false where it is
  /// not known.
  bool hessian(double weight, const Eigen::VectorXd& multipliers, Eigen::MatrixXd& H)
  {
    return stop_ == Stop::none && problem_.hessian(accepted_.x, weight, multipliers, H);
  }

  const ScaledProblem& problem() const { return problem_; }
  const Place& accepted() const { return accepted_; }
  const BestPoint& best() const { return best_; }
  Stop stopped() const { return stop_; }
  bool blocked() const { return blocked_; }  ///< the last place is not on a safe way
  int iterations() const { return iteration_; }
  /// Multipliers of least squares at the accepted point; empty where they are not known.
  const Eigen::VectorXd& multipliers() const { return multipliers_; }
  /// The unit of objective values: |value| at the start, or 1.
  double unit() const { return unit_; }

  /// The conditions of first order hold at the best point.
  bool critical() const;
  /// No small step from the best point reduces the violation of the constraints.
  bool infeasible() const;
  OptimizerResult finish(std::string status, std::string message) const;
  /// The result of a run that was stopped.
  OptimizerResult finish_stopped() const;

 private:
  bool reachable(const Eigen::VectorXd& x);
  void evaluate(Place& place, bool want_gradient);
  /// Enters what was found at the place, and its constraints.
  void enter(Place& place, const Trial& trial, bool want_gradient);
  Step descent(const Place& place) const;
  void report(double step);

  ScaledProblem problem_;
  WalkSettings settings_;
  OptimizerObserver& observer_;
  Place accepted_, last_, best_place_;
  BestPoint best_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd direction_;  ///< scaled, from the accepted point, asked for last; empty: none
  double safe_ = 0.0;          ///< its safe part
  double first_value_ = 0.0;
  double unit_ = 1.0;
  int iteration_ = 0;
  bool blocked_ = false;
  Stop stop_ = Stop::none;
};

}  // namespace hauberk
