#pragma once
/// A kernel problem as a library sees it that asks for values anywhere and cannot be told that there are
/// none.

#include "nlopt_optimizer.hpp"

#include <hauberk/optimizer.hpp>

#include <common/best_point.hpp>
#include <common/criticality.hpp>
#include <common/scaled_problem.hpp>

#include <exception>
#include <span>
#include <string>

namespace hauberk {

/// Answers questions about scaled variables z and the objective over `unit()`.
///
/// Where a point is not on the safe way from the accepted one, or cannot be evaluated, the answer is a wall:
/// a value above all seen, rising away from the accepted point, and the constraints linearised there. Nothing
/// of it is ever accepted or returned. A point is accepted when it improves the best one or lowers the l1
/// merit function; then the observer hears of it. Not thread safe.
class NloptAdapter {
 public:
  /// `walls`: of one run of NLopt only.
  enum class Stop { none, observer, iterations, evaluations, exception, walls };

  NloptAdapter(OptimizationProblem& problem, const NloptSettings& settings, OptimizerObserver& observer,
               std::span<const double> start);

  /// Evaluates and accepts the start; false when that fails.
  bool begin(std::string& why);

  /// Objective over its unit, and its gradient where that is not null.
  double objective(const double* z, double* gradient);
  /// -c (feasible where <= 0), and -J row-major where that is not null.
  void constraints(const double* z, double* values, double* jacobian);

  Eigen::Index size() const { return problem_.size(); }
  Eigen::Index constraint_count() const { return accepted_.at.c.size(); }
  Eigen::VectorXd lower() const { return problem_.scaled(problem_.lower()); }
  Eigen::VectorXd upper() const { return problem_.scaled(problem_.upper()); }
  /// The accepted point.
  Eigen::VectorXd position() const { return problem_.scaled(accepted_.x); }
  double unit() const { return unit_; }

  /// From now on nothing is asked of the problem any more.
  void stop(Stop why) { stop_ = why; }
  /// Ends with an exception, which `rethrow` throws again.
  void fail(std::exception_ptr exception);
  Stop stopped() const { return stop_; }
  /// After a run of NLopt: true if it was ended because of walls. The next one may begin.
  bool leave_walls()
  {
    walls_ = 0;
    if (stop_ != Stop::walls) return false;
    stop_ = Stop::none;
    return true;
  }
  void rethrow() const;

  /// Moves the accepted point onto the linearised constraints a few times, as methods that come from outside
  /// end slightly beyond them.
  void restore();
  /// Asks for derivatives at the best point, where none are known.
  void differentiate();
  /// The conditions of first order hold at the best point.
  bool critical() const;
  /// No small step from the best point reduces the violation.
  bool infeasible() const;
  /// Merit of the accepted point: what a further run must lower.
  double merit() const { return merit(accepted_); }
  /// Largest violation of the accepted point.
  double violation() const { return largest_violation(accepted_.at.c); }
  bool blocked() const { return blocked_; }
  OptimizerResult finish(std::string status, std::string message) const;

 private:
  struct Point {
    Eigen::VectorXd x;
    bool ok = false;
    bool derivatives = false;
    double value = 0.0;
    Linearisation at;
  };

  const Point& look(const double* z, bool want_gradient);
  void evaluate(Point& p, bool want_gradient);
  void consider(const Point& p);
  double merit(const Point& p) const { return p.value + penalty_ * total_violation(p.at.c); }
  Step descent(const Point& p) const;
  bool report(const Point& p, double step);

  ScaledProblem problem_;
  NloptSettings settings_;
  OptimizerObserver& observer_;
  Point accepted_, last_, best_point_;
  BestPoint best_;
  double first_value_ = 0.0;
  double unit_ = 1.0;
  double worst_ = 0.0;    ///< largest value seen
  double penalty_ = 0.0;  ///< of the l1 merit function
  int iteration_ = 0;
  bool blocked_ = false;  ///< the last point that was asked for is not on a safe way
  Stop stop_ = Stop::none;
  int walls_ = 0;  ///< questions since the last evaluation
  std::exception_ptr exception_;
};

}  // namespace hauberk
