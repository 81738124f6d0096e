/// Checks of how optimizers treat bounds, budgets, failures and whoever watches them.

#include "checks.hpp"
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::conformance {
namespace {

const std::vector<double> valley_start{-1.2, 1.0};

FunctionProblem valley() { return rosenbrock(-2.0, 2.0); }

/// sum_i a_i (x_i - c_i)^2 within [-1, 1], c partly outside: the minimum is at c clamped.
struct Bowl {
  FunctionProblem problem = box(5, -1.0, 1.0);
  std::vector<double> start, solution;
  double least = 0.0;

  explicit Bowl(Random& random)
  {
    VectorXd a(5), c(5);
    for (Eigen::Index i = 0; i < 5; ++i) {
      a[i] = random.scale(0.3, 3.0);
      c[i] = random.between(-2.0, 2.0);
      start.push_back(random.between(-1.0, 1.0));
      solution.push_back(std::clamp(c[i], -1.0, 1.0));
      least += a[i] * (solution.back() - c[i]) * (solution.back() - c[i]);
    }
    problem.objective = [a, c](const VectorXd& x, VectorXd& g) {
      g = 2.0 * a.cwiseProduct(x - c);
      return a.dot((x - c).cwiseAbs2());
    };
  }
};

void bounds(Trial& trial)
{
  const Object object = trial.make();
  for (int draw = 0; draw < 6; ++draw) {
    Bowl bowl(trial.random);
    const OptimizerResult r = watched(*object.optimizer, bowl.problem, bowl.start).result;
    require(std::abs(r.value - bowl.least) <= 1e-3 * (1.0 + bowl.least),
            "'{}' at {:.9g} of a separable quadratic within bounds whose least value is {:.9g}", r.status,
            r.value, bowl.least);
  }
}

void start_at_optimum(Trial& trial)
{
  const Object object = trial.make();
  for (int draw = 0; draw < 3; ++draw) {
    Bowl bowl(trial.random);
    const OptimizerResult r = watched(*object.optimizer, bowl.problem, bowl.solution).result;
    require(r.status == "converged" || r.status == "small_step",
            "started at the optimum it ends with '{}': {}", r.status, r.message);
    for (std::size_t i = 0; i < r.x.size(); ++i)
      require(std::abs(r.x[i] - bowl.solution[i]) <= 1e-3, "started at the optimum {:.6g} it ends at {:.6g}",
              bowl.solution[i], r.x[i]);
  }
}

void fixed_variables(Trial& trial)
{
  const Object object = trial.make();
  FunctionProblem problem = valley();
  problem.lower_bounds[0] = problem.upper_bounds[0] = -1.2;
  const OptimizerResult r = watched(*object.optimizer, problem, valley_start).result;
  require(r.x[0] == -1.2, "a variable whose bounds are equal moved to {}", r.x[0]);
  require(std::abs(r.x[1] - 1.44) <= 1e-2,
          "beside a fixed variable, x[1] ends at {:.6g}; the optimum is 1.44", r.x[1]);
}

void observer(Trial& trial)
{
  const Object object = trial.make();
  for (const int limit : {1, 2, 3, 5, 8}) {
    FunctionProblem problem = valley();
    const Run run = watched(*object.optimizer, problem, valley_start, limit);
    require(run.result.status == "stopped", "stopped by the observer at iterate {}, its status is '{}'",
            limit - 1, run.result.status);
    require(problem.evaluated.size() == run.watcher.evaluations_at_stop,
            "it went on to evaluate after the observer had stopped it at iterate {}", limit - 1);
  }
}

/// The section with a whole number of its own set; skips where it has no such field.
Object with_budget(Trial& trial, const std::string& name, int budget)
{
  Node values = trial.section.values;
  for (auto& [key, value] : values.members) {
    if (key != name) continue;
    value.number = budget;
    Problems problems;
    Object object = trial.make(values, problems);
    require(problems.empty(), "{} = {} is refused", name, budget);
    return object;
  }
  skip("it has no field {}", name);
}

void evaluation_budget(Trial& trial)
{
  for (const int budget : {1, 2, 9, 30}) {
    const Object object = with_budget(trial, "max_evaluations", budget);
    FunctionProblem problem = valley();
    const OptimizerResult r = watched(*object.optimizer, problem, valley_start).result;
    require(problem.evaluated.size() <= static_cast<std::size_t>(budget),
            "with max_evaluations {} it made {} evaluations", budget, problem.evaluated.size());
    require(r.status == "iteration_limit" || problem.evaluated.size() < static_cast<std::size_t>(budget),
            "with its {} evaluations used, its status is '{}'; expected 'iteration_limit'", budget, r.status);
  }
}

void iteration_budget(Trial& trial)
{
  for (const int budget : {0, 1, 4}) {
    const Object object = with_budget(trial, "max_iterations", budget);
    FunctionProblem problem = valley();
    const OptimizerResult r = watched(*object.optimizer, problem, valley_start).result;
    require(r.iterations <= budget, "with max_iterations {} it made {} iterations", budget, r.iterations);
    require(r.status == "iteration_limit" || r.iterations < budget,
            "with its {} iterations used, its status is '{}'; expected 'iteration_limit'", budget, r.status);
  }
}

void failing_start(Trial& trial)
{
  const Object object = trial.make();
  FunctionProblem problem = valley();
  problem.fails = [](const VectorXd&) { return true; };
  const OptimizerResult r = watched(*object.optimizer, problem, valley_start).result;
  require(r.status == "failed", "nothing can be evaluated, not even the start, and its status is '{}'",
          r.status);
  require(r.x == valley_start, "the start could not be evaluated, and the result is another point");
}

void only_the_start(Trial& trial)
{
  const Object object = trial.make();
  FunctionProblem problem = valley();
  problem.fails = [](const VectorXd& x) { return x[0] != valley_start[0] || x[1] != valley_start[1]; };
  const OptimizerResult r = watched(*object.optimizer, problem, valley_start).result;
  require(r.x == valley_start, "only the start can be evaluated, and the result is another point");
  require(r.status != "converged",
          "only the start can be evaluated, its gradient is not zero, and it says 'converged'");
}

void nothing_safe(Trial& trial)
{
  const Object object = trial.make();
  for (const double alpha : {0.0, std::nan("")}) {
    FunctionProblem problem = valley();
    problem.safe = [alpha](const VectorXd&, const VectorXd&) { return alpha; };
    const OptimizerResult r = watched(*object.optimizer, problem, valley_start).result;
    require(r.x == valley_start, "no step is safe, and the result is not the start");
    require(r.status != "converged", "no step is safe, the gradient is not zero, and it says 'converged'");
  }
}

/// Thrown by an objective.
struct Hiccup {};

void exceptions(Trial& trial)
{
  const Object object = trial.make();
  for (const int where : {1, 2, 7}) {
    FunctionProblem problem = valley();
    const auto smooth = problem.objective;
    int calls = 0;
    problem.objective = [&](const VectorXd& x, VectorXd& g) {
      if (++calls == where) throw Hiccup{};
      return smooth(x, g);
    };
    Recorder recorder;
    bool passed_through = false;
    try {
      static_cast<void>(object.optimizer->minimize(problem, valley_start, recorder));
    } catch (const Hiccup&) {
      passed_through = true;
    }
    require(passed_through, "what evaluation {} threw did not come back", where);
    require(calls == where, "evaluation {} threw, and it went on to evaluate", where);
  }
}

}  // namespace

void add_optimizer_checks(std::vector<Check>& out)
{
  const auto add = [&](const char* name, const char* about, void (*function)(Trial&)) {
    out.push_back(of_trial(name, PluginKind::optimizer, about, function));
  };
  add("optimizer.bounds", "bounds are kept at every evaluation, and found where the optimum is on them",
      bounds);
  add("optimizer.start_at_optimum", "a start at the optimum stays there", start_at_optimum);
  add("optimizer.fixed_variables", "a variable whose bounds are equal stays, the others move",
      fixed_variables);
  add("optimizer.observer", "the observer can stop it at every iterate, at once", observer);
  add("optimizer.evaluation_budget", "max_evaluations is kept", evaluation_budget);
  add("optimizer.iteration_budget", "max_iterations is kept", iteration_budget);
  add("optimizer.failing_start", "a start that cannot be evaluated is 'failed'", failing_start);
  add("optimizer.only_the_start", "where nothing but the start can be evaluated, it ends there",
      only_the_start);
  add("optimizer.nothing_safe", "where no step is safe, nothing but the start is evaluated", nothing_safe);
  add("optimizer.exceptions", "what the objective throws comes back, and nothing is asked after it",
      exceptions);
}

}  // namespace hauberk::conformance
