#pragma once
/// Whether a run of an optimizer kept the contract and told the truth.

#include "verdict.hpp"

#include <hauberk/conformance/known_problems.hpp>

#include <string>

namespace hauberk::conformance {

/// Violation of a constraint that counts as none in a result.
constexpr double tolerated_violation = 1e-6;

/// Looks at every iterate: numbered from 0, the accepted point, with its value. Stops after `limit` of them.
class Watcher : public OptimizerObserver {
 public:
  explicit Watcher(const FunctionProblem& problem) : problem_(problem) {}
  bool on_iterate(const OptimizerIterate& iterate) override;

  int limit = 1 << 30;
  int count = 0;
  std::string wrong;  ///< the first thing that was wrong, a sentence; empty: nothing
  std::size_t evaluations_at_stop = 0;

 private:
  std::string defect(const OptimizerIterate& iterate) const;
  const FunctionProblem& problem_;
};

/// The value of the problem's objective at x, apart from its records.
double value_at(const FunctionProblem& problem, const VectorXd& x);
/// The largest of |c| of equations and max(0, -c) of inequalities at x.
double violation_at(const FunctionProblem& problem, const VectorXd& x);

/// A run and what watched it.
struct Run {
  OptimizerResult result;
  Watcher watcher;
};

/// Minimises and holds the run to the contract, whatever the problem is: the protocol of calls, iterates,
/// counts, a result that was accepted, with the value it has, no worse than a feasible start, feasible where
/// it says so. Throws Failure. Throws Skip where the problem has equations and the optimizer does not declare
/// that it keeps some, and where it says that it takes no constraints: status "failed" after at most one
/// evaluation, and a message about constraints.
Run watched(const Optimizer& optimizer, FunctionProblem& problem, const std::vector<double>& start,
            int limit = 1 << 30);

}  // namespace hauberk::conformance
