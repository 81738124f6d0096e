/// Whether an optimizer solves problems whose solutions are known.

#include "as_vector.hpp"
#include "checks.hpp"
#include "judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace hauberk::conformance {
namespace {

/// Error in the value, relative to 1 + |value|: of what is said to be converged, and of a smooth problem
/// within bounds that is not.
constexpr double converged_error = 1e-4, stalled_error = 1e-2;

/// Smooth, only bounds: whoever optimises solves them. (Constraints may be refused, kinks may stop a method
/// that says so.)
constexpr std::array<std::string_view, 3> plain = {"quadratic", "rosenbrock", "rosenbrock_bound"};

/// Of the solution of a problem with equations, component by component, relative to 1 + |x_i|: of first
/// order, where the value's is of second.
constexpr double solution_error = 1e-2;

struct KnownText {
  const char* name;
  const char* about;
};
constexpr KnownText known_texts[] = {
    {"quadratic", "a convex quadratic, three of six bounds active"},
    {"rosenbrock", "Rosenbrock's valley without bounds"},
    {"rosenbrock_bound", "Rosenbrock's valley cut by a bound"},
    {"hs71", "Hock and Schittkowski 71: a curved equation and a curved inequality"},
    {"hs76", "Hock and Schittkowski 76: linear inequalities"},
    {"circle", "a linear function in a disk"},
    {"degenerate", "five constraints, one of them twice, at a vertex of two dimensions"},
    {"contradiction", "constraints that contradict each other are not said to be satisfied"},
    {"no_ball", "a curved constraint that nothing satisfies"},
    {"kinked", "half a sum of squares of residuals with kinks: solved, or not said to be"},
    {"hs6", "Hock and Schittkowski 6: a curved equation, from far outside"},
    {"hs7", "Hock and Schittkowski 7: a curved equation, a logarithm"},
    {"hs28", "Hock and Schittkowski 28: a linear equation"},
    {"hs48", "Hock and Schittkowski 48: two linear equations of five variables"},
    {"hs71_equation", "Hock and Schittkowski 71 with its equation as one, an inequality and bounds"},
    {"no_root", "an equation that nothing satisfies"},
    {"failing", "points that cannot be evaluated beside the way"},
    {"not_a_number", "values and gradients that are not finite beside the way"},
    {"short_way", "no step longer than 0.2 is safe"},
    {"wall", "nothing beyond x0 = 0.4 can be reached, and nothing beyond it is evaluated"}};

void check_error(const KnownProblem& k, const OptimizerResult& r, double at_start)
{
  const bool is_plain = std::find(plain.begin(), plain.end(), k.name) != plain.end();
  const bool claimed = r.status == "converged";
  if (!claimed && !is_plain) return;
  const double scale = 1.0 + std::abs(*k.value) + std::abs(at_start - *k.value);
  const double error = std::abs(r.value - *k.value) / scale;
  require(error <= (claimed ? converged_error : stalled_error),
          "'{}' at the value {:.9g}; the least value is {:.9g} ({})", r.status, r.value, *k.value, r.message);
}

/// Whoever keeps equations ends at the one solution of each of these problems.
void check_equations(const KnownProblem& k, const OptimizerResult& r)
{
  const VectorXd x = as_vector(r.x);
  require(violation_at(k.problem, x) <= tolerated_violation,
          "'{}' at a point that violates a constraint by {:.3g}", r.status, violation_at(k.problem, x));
  for (std::size_t i = 0; i < r.x.size(); ++i)
    require(std::abs(r.x[i] - k.solution[i]) <= solution_error * (1.0 + std::abs(k.solution[i])),
            "'{}' at x[{}] = {:.6g}; the solution is {:.6g} ({})", r.status, i, r.x[i], k.solution[i],
            r.message);
}

void solve(Trial& trial, const std::string& name)
{
  KnownProblem k = known_problem(name);
  const Object object = trial.make();
  const OptimizerResult r = watched(*object.optimizer, k.problem, k.start).result;
  require(r.status != "failed" && r.status != "stopped", "'{}': {}", r.status, r.message);
  if (!k.feasible) {
    require(r.status != "converged", "it says 'converged', and no point satisfies the constraints");
    return;
  }
  require(r.status != "infeasible",
          "it says 'infeasible', and (x = {:.4g}, ...) satisfies all constraints: {}",
          k.solution.empty() ? k.start[0] : k.solution[0], r.message);
  const VectorXd start =
      Eigen::Map<const VectorXd>(k.start.data(), static_cast<Eigen::Index>(k.start.size()));
  const double at_start = value_at(k.problem, start);
  if (k.wall) {
    require(r.status != "converged", "it says 'converged' before a wall, where the gradient is not zero");
    require(r.value < 0.5 * at_start, "it gets only from {:.6g} to {:.6g} before the wall", at_start,
            r.value);
    return;
  }
  check_error(k, r, at_start);
  if (k.problem.equality_number > 0) check_equations(k, r);
}

}  // namespace

void add_known_problem_checks(std::vector<Check>& out)
{
  for (const KnownText& text : known_texts) {
    const std::string name = text.name;
    out.push_back(of_trial("optimizer.solves." + name, PluginKind::optimizer, text.about,
                           [name](Trial& trial) { solve(trial, name); }));
  }
}

}  // namespace hauberk::conformance
