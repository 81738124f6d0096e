#pragma once
/// A kernel problem as a library sees it that asks for values anywhere and cannot be told that there are
/// none.

#include "nlopt_optimizer.hpp"

#include <hauberk/optimizer.hpp>

#include <common/walk.hpp>

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
  NloptAdapter(OptimizationProblem& problem, const NloptSettings& settings, OptimizerObserver& observer,
               std::span<const double> start);

  /// Evaluates and accepts the start; false when that fails.
  bool begin(std::string& why);

  /// Objective over its unit, and its gradient where that is not null.
  double objective(const double* z, double* gradient);
  /// -c of `count` constraints from `first` on (feasible where <= 0, of equations where 0), and -J row-major
  /// where that is not null.
  void constraints(const double* z, Eigen::Index first, Eigen::Index count, double* values, double* jacobian);

  Eigen::Index size() const { return walk_.problem().size(); }
  Eigen::Index constraint_count() const { return walk_.accepted().at.c.size(); }
  Eigen::Index equality_count() const { return walk_.accepted().at.equalities; }
  Eigen::VectorXd lower() const { return walk_.problem().scaled(walk_.problem().lower()); }
  Eigen::VectorXd upper() const { return walk_.problem().scaled(walk_.problem().upper()); }
  /// The accepted point.
  Eigen::VectorXd position() const { return walk_.problem().scaled(walk_.accepted().x); }
  double unit() const { return walk_.unit(); }

  /// Nothing more is asked of the problem: a run of NLopt has to end.
  bool ended() const { return walled_ || exception_ || stopped(); }
  /// Observer or budgets ended it all.
  bool stopped() const { return walk_.stopped() != Walk::Stop::none; }
  /// Ends with an exception, which `rethrow` throws again.
  void fail(std::exception_ptr exception) { exception_ = std::move(exception); }
  void rethrow() const;
  /// After a run of NLopt: true if it was ended because of walls. The next one may begin.
  bool leave_walls();

  /// Moves the accepted point onto the linearised constraints a few times, as methods that come from outside
  /// end slightly beyond them.
  void restore();
  /// Asks for derivatives at the best point, where none are known.
  void differentiate() { walk_.differentiate(); }
  /// Merit of the accepted point: what a further run must lower.
  double merit() const { return merit(walk_.accepted()); }
  /// Largest violation of the accepted point.
  double violation() const { return largest_violation(walk_.accepted().at); }
  const Walk& walk() const { return walk_; }

 private:
  const Walk::Place& look(const double* z, bool want_gradient);
  double merit(const Walk::Place& p) const { return p.value + penalty_ * total_violation(p.at); }
  /// Raises the penalty above the multipliers of the accepted point.
  void raise_penalty();

  Walk walk_;
  Walk::Place refused_;   ///< asked for after the end
  bool gradients_;        ///< the algorithm asks for some
  double worst_ = 0.0;    ///< largest value seen
  double penalty_ = 0.0;  ///< of the l1 merit function
  int walls_ = 0;         ///< questions since the last evaluation
  bool walled_ = false;   ///< they were too many
  std::exception_ptr exception_;
};

}  // namespace hauberk
