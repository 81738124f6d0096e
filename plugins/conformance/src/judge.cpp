#include "judge.hpp"

#include "as_vector.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk::conformance {
namespace {

/// Equal up to the rounding of scaling and back.
bool nearly(double a, double b) { return std::abs(a - b) <= 1e-12 * (1.0 + std::abs(b)); }

void check_counts(const OptimizerResult& r, const FunctionProblem& problem, const Watcher& watcher)
{
  require(static_cast<std::size_t>(r.evaluations) == problem.evaluated.size(),
          "it counts {} evaluations, and made {}", r.evaluations, problem.evaluated.size());
  require(watcher.count == 0 || watcher.count == r.iterations + 1,
          "it counts {} iterations and told the observer of {} iterates, the start among them", r.iterations,
          watcher.count);
  require(static_cast<std::size_t>(watcher.count) == problem.accepted.size(),
          "it told the observer of {} iterates and accepted {}", watcher.count, problem.accepted.size());
}

void check_result(const OptimizerResult& r, const FunctionProblem& problem, const std::vector<double>& start)
{
  require(!r.message.empty(), "its status '{}' comes without a message", r.status);
  if (problem.accepted.empty()) {
    require(r.status == "failed", "it accepted no point, not even the start, and its status is '{}'",
            r.status);
    return;
  }
  const VectorXd x = as_vector(r.x);
  require(std::find(problem.accepted.begin(), problem.accepted.end(), x) != problem.accepted.end(),
          "the result was never accepted");
  const double value = value_at(problem, x);
  require(nearly(r.value, value), "the value of the result is {:.12g}, and {:.12g} is given", value, r.value);
  const double violation = violation_at(problem, x);
  if (r.status == "converged")
    require(violation <= tolerated_violation,
            "it says 'converged' at a point that violates a constraint by {:.3g}", violation);
  const double before = value_at(problem, as_vector(start));
  if (violation_at(problem, as_vector(start)) > 0.0 || problem.fails(as_vector(start)) ||
      !std::isfinite(before))
    return;
  require(violation <= tolerated_violation,
          "the start was feasible, the result violates a constraint by {:.3g}", violation);
  // Points may be better by violating constraints by what counts as none.
  require(r.value <= before + 1e-9 * (1.0 + std::abs(before)),
          "the result {:.12g} is worse than the start {:.12g}", r.value, before);
}

}  // namespace

double value_at(const FunctionProblem& problem, const VectorXd& x)
{
  VectorXd gradient(x.size());
  return problem.objective(x, gradient);
}

double violation_at(const FunctionProblem& problem, const VectorXd& x)
{
  if (problem.constraint_number == 0) return 0.0;
  VectorXd c(problem.constraint_number);
  RowMajor J(problem.constraint_number, x.size());
  problem.constraint_functions(x, c, J);
  double worst = 0.0;
  for (int i = 0; i < problem.constraint_number; ++i)
    worst = std::max(worst, i < problem.equality_number ? std::abs(c[i]) : -c[i]);
  return worst;
}

std::string Watcher::defect(const OptimizerIterate& iterate) const
{
  if (iterate.iteration != count) return fmt::format("iterate {} is called {}", count, iterate.iteration);
  if (problem_.accepted.empty() || as_vector(iterate.x) != problem_.accepted.back())
    return fmt::format("iterate {} is not the point accepted last", count);
  const double value = value_at(problem_, as_vector(iterate.x));
  if (!nearly(iterate.value, value))
    return fmt::format("iterate {} has the value {:.12g}, and the observer was told {:.12g}", count, value,
                       iterate.value);
  return {};
}

bool Watcher::on_iterate(const OptimizerIterate& iterate)
{
  if (wrong.empty() && count >= limit) wrong = "it went on after the observer had stopped it";
  if (wrong.empty()) wrong = defect(iterate);
  ++count;
  evaluations_at_stop = problem_.evaluated.size();
  return count < limit;
}

Run watched(const Optimizer& optimizer, FunctionProblem& problem, const std::vector<double>& start, int limit)
{
  if (problem.equality_number > 0 && !optimizer.traits().equalities)
    skip("it does not declare that it keeps equality constraints");
  Run run{{}, Watcher(problem)};
  run.watcher.limit = limit;
  run.result = optimizer.minimize(problem, start, run.watcher);
  const OptimizerResult& r = run.result;
  const bool refused = problem.constraint_number > 0 && r.status == "failed" &&
                       problem.evaluated.size() <= 1 && r.message.find("constraint") != std::string::npos;
  require(!refused || problem.equality_number == 0,
          "it declares that it keeps equality constraints, and takes none: {}", r.message);
  if (refused) skip("it takes no constraints: {}", r.message);
  require(problem.breach.empty(), "{}", problem.breach);
  require(run.watcher.wrong.empty(), "{}", run.watcher.wrong);
  check_counts(r, problem, run.watcher);
  check_result(r, problem, start);
  return run;
}

}  // namespace hauberk::conformance
