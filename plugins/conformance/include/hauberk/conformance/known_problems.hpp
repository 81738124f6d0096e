#pragma once
/// Problems whose solutions are known, for the tests of every optimizer.

#include "function_problem.hpp"

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace hauberk::conformance {

/// n variables within the same bounds; functions are still to be set.
FunctionProblem box(std::size_t n, double lower, double upper);

/// (1 - x0)^2 + 100 (x1 - x0^2)^2 within the same bounds for both.
FunctionProblem rosenbrock(double lower, double upper);

/// rosenbrock(-2, 2) with variables in multiples of `unit`: x = 1/unit is what x = 1 is there.
FunctionProblem rosenbrock_in_units(double unit);

/// Hock and Schittkowski 71, its equation as two inequalities. Optimum 17.0140172891.
FunctionProblem hs71();

/// The same with its equation as one, the first constraint.
FunctionProblem hs71_equation();

/// Hock and Schittkowski 76: three linear inequalities. Optimum -103/22.
FunctionProblem hs76();

/// -3 x0 - 4 x1 within the unit disk, variables within +-half_range. Optimum -5 at (0.6, 0.8).
FunctionProblem farthest_in_disk(double half_range);

/// Half the sum of squares of residuals, which the optimizer sees only if `shown`.
FunctionProblem sum_of_squares(FunctionProblem problem, int count,
                               std::function<void(const VectorXd&, VectorXd&, RowMajor&)> residuals,
                               bool shown);

/// Residuals r_i = min(a_i . x, b_i . x) - 1 with kinks, as limits have them: they rise fastest where two
/// contacts are equal. Half the sum of squares, with r_(n+i) = x_i/2 added, is convex below zero and the same
/// for all cyclic permutations of x: it is least at equal components t, where all six kinks meet. There
/// r_i = 1.4 t - 1, so t = 1.4/(1.4^2 + 1/4). n = 6, 12 residuals.
void kinked_residuals(const VectorXd& x, VectorXd& r, RowMajor& J);

/// A problem, where to start, and what must come out.
struct KnownProblem {
  std::string name;
  FunctionProblem problem;
  std::vector<double> start;
  /// Where the problem has a solution, its value; null where it is infeasible or the way to it is blocked.
  std::optional<double> value;
  std::vector<double> solution;  ///< empty where it is not unique, or there is none
  bool feasible = true;
  /// Where the way is blocked: statuses but "converged" are expected, and x0 stays below this.
  std::optional<double> wall;
};

/// For test frameworks that print parameters.
inline void PrintTo(const KnownProblem& k, std::ostream* out) { *out << k.name; }

/// All of them, with Hessians that can be offered where they are smooth:
/// - quadratic: convex, coupled, three of six bounds active
/// - rosenbrock: without bounds; rosenbrock_bound: x0 <= 0.5
/// - hs71: curved equation and inequality; hs76: linear inequalities, active; circle: curved inequality
/// - degenerate: five constraints, one of them twice, at a vertex of two dimensions
/// - contradiction, no_ball: infeasible, linear and curved
/// - kinked: half a sum of squares of kinked residuals
/// - hs6, hs7: one curved equation; hs28, hs48: one and two linear ones; hs71_equation: a curved equation, a
///   curved inequality and bounds; no_root: an equation that nothing satisfies
/// - failing, not_a_number: Rosenbrock's valley between points that cannot be evaluated
/// - short_way: no step longer than 0.2 is safe
/// - wall: nothing beyond x0 = 0.4 can be reached
std::vector<KnownProblem> known_problems();
/// The one of that name; throws std::out_of_range when there is none.
KnownProblem known_problem(const std::string& name);

}  // namespace hauberk::conformance
