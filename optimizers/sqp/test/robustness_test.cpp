/// What goes wrong in practice: infeasible problems, evaluations that fail, kinks, intersections in the way.

#include "../sqp.hpp"

#include <hauberk/conformance/known_problems.hpp>
#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hauberk {
namespace {

using namespace conformance;

OptimizerResult minimise(FunctionProblem& problem, const std::vector<double>& start, Recorder& recorder,
                         const SqpSettings& settings = {})
{
  OptimizerResult result = Sqp(settings).minimize(problem, start, recorder);
  EXPECT_EQ(problem.breach, "");
  return result;
}

TEST(SqpRobustness, ContradictingConstraintsAreSaidToBeInfeasible)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.constraint_number = 2;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x[0] - 1.0, -0.5 - x[0];
    J << 1, 0, -1, 0;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "infeasible");
  EXPECT_NE(r.message.find("violated by up to "), std::string::npos) << r.message;
}

TEST(SqpRobustness, CurvedInfeasibleProblem)
{
  // -1 - x.x >= 0 has no solution although every linearisation away from 0 has one.
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.constraint_number = 1;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << -1.0 - x.squaredNorm();
    J.row(0) = -2.0 * x;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "infeasible") << r.message;
  EXPECT_LT(std::hypot(r.x[0], r.x[1]), 0.1);  // least violation is at 0
  EXPECT_LT(r.evaluations, 150);
}

TEST(SqpRobustness, InfeasibleLinearisationIsRelaxed)
{
  // At the start the two linearisations contradict each other inside the bounds, yet the problem is feasible.
  FunctionProblem problem = box(1, -1.0, 4.0);
  problem.objective = [](const VectorXd& x, VectorXd& g) {
    g << 1.0;
    return x[0];
  };
  problem.constraint_number = 2;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x[0] * x[0] * x[0] - 8.0, 4.0 - x[0];
    J << 3.0 * x[0] * x[0], -1.0;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {0.5}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.x[0], 2.0, 1e-6);
}

TEST(SqpRobustness, FailingEvaluationsShortenTheStep)
{
  // The valley is cut by a strip in which nothing can be evaluated.
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.fails = [](const VectorXd& x) { return x[0] > -0.8 && x[0] < -0.7 && x[1] < 1.0; };
  Recorder recorder;
  SqpSettings settings;
  settings.tolerance = 1e-10;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder, settings);
  EXPECT_TRUE(r.status == "converged" || r.status == "small_step") << r.status;
  EXPECT_LT(r.value, 4.0);
  EXPECT_LT(r.evaluations, 150);
  for (const VectorXd& x : problem.accepted) EXPECT_FALSE(problem.fails(x));
}

TEST(SqpRobustness, NotANumberIsAFailedEvaluation)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  const auto smooth = problem.objective;
  int calls = 0;
  problem.objective = [&](const VectorXd& x, VectorXd& g) {
    const double value = smooth(x, g);
    ++calls;
    if (calls % 5 == 2) return std::numeric_limits<double>::quiet_NaN();
    if (calls % 5 == 4) g[1] = std::numeric_limits<double>::infinity();
    return value;
  };
  Recorder recorder;
  SqpSettings settings;
  settings.tolerance = 1e-10;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder, settings);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.x[0], 1.0, 1e-4);
}

TEST(SqpRobustness, StartThatFailsIsReported)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.fails = [](const VectorXd&) { return true; };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "failed");
  EXPECT_EQ(r.message, "the start cannot be evaluated: told to fail");
  EXPECT_EQ(r.x, (std::vector<double>{-1.2, 1.0}));
  EXPECT_EQ(r.evaluations, 1);
  EXPECT_TRUE(recorder.iterates.empty());
}

TEST(SqpRobustness, ConstraintsThatAreNotFiniteAtTheStart)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.constraint_number = 1;
  problem.constraint_functions = [](const VectorXd&, VectorXd& c, RowMajor& J) {
    c << std::nan("");
    J.setZero();
  };
  Recorder recorder;
  EXPECT_EQ(minimise(problem, {-1.2, 1.0}, recorder).message,
            "the start cannot be evaluated: the constraints or their derivatives are not finite");
}

TEST(SqpRobustness, ObserverStops)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  Recorder recorder;
  recorder.limit = 4;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "stopped");
  EXPECT_EQ(r.iterations, 3);
  EXPECT_EQ(recorder.iterates.size(), 4U);
  EXPECT_EQ(r.value, recorder.iterates.back().value);
}

TEST(SqpRobustness, IterationLimit)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  Recorder recorder;
  SqpSettings settings;
  settings.max_iterations = 2;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder, settings);
  EXPECT_EQ(r.status, "iteration_limit");
  EXPECT_EQ(r.iterations, 2);
}

TEST(SqpRobustness, StaysBehindAWall)
{
  // Nothing beyond x0 = 0.4 can be reached: the way ends there, and the constraints do not know.
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.safe = [](const VectorXd& x, const VectorXd& d) {
    return d[0] <= 0.0 ? 1.0 : std::clamp((0.4 - x[0]) / d[0], 0.0, 1.0);
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "small_step");
  EXPECT_EQ(r.message, "the next step would pass through an intersection");
  for (const VectorXd& x : problem.evaluated) EXPECT_LE(x[0], 0.4 + 1e-12);
  EXPECT_NEAR(r.x[0], 0.4, 1e-3);
  EXPECT_LT(r.evaluations, 100);
}

TEST(SqpRobustness, SafeStepThatIsNotANumberMovesNothing)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.safe = [](const VectorXd&, const VectorXd&) { return std::nan(""); };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "small_step");
  EXPECT_EQ(r.evaluations, 1);
}

TEST(SqpRobustness, KinkDoesNotLoop)
{
  // The minimum (0.3, 0.3) is a kink in both directions.
  FunctionProblem problem = box(2, -1.0, 1.0);
  problem.objective = [](const VectorXd& x, VectorXd& g) {
    const double a = x[0] - 0.3;
    const double b = x[1] - x[0];
    g << (a < 0 ? -1.0 : 1.0) - (b < 0 ? -5.0 : 5.0), b < 0 ? -5.0 : 5.0;
    return 1.0 + std::abs(a) + 5.0 * std::abs(b);
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-0.9, 0.7}, recorder);
  EXPECT_TRUE(r.status == "small_step" || r.status == "converged") << r.status;
  EXPECT_LT(r.value, 1.1);
  EXPECT_LT(r.evaluations, 150);
}

TEST(SqpRobustness, NoisyObjectiveEnds)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  const auto smooth = problem.objective;
  problem.objective = [smooth](const VectorXd& x, VectorXd& g) {
    return smooth(x, g) + 1e-4 * std::sin(1e7 * x[0] + 3e7 * x[1]);
  };
  Recorder recorder;
  SqpSettings settings;
  settings.tolerance = 1e-12;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder, settings);
  EXPECT_LT(r.value, 1e-2);
  EXPECT_LT(r.evaluations, 150);
}

TEST(SqpRobustness, WrongGradientEnds)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  const auto smooth = problem.objective;
  problem.objective = [smooth](const VectorXd& x, VectorXd& g) {
    const double value = smooth(x, g);
    g = -g;
    return value;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "small_step");
  EXPECT_EQ(r.x, (std::vector<double>{-1.2, 1.0}));
  EXPECT_LT(r.evaluations, 30);
}

TEST(SqpRobustness, ReturnsTheBestFeasiblePoint)
{
  // From a feasible start the first steps leave the circle to second order: what is returned keeps to it.
  FunctionProblem problem = hs71();
  for (int limit = 1; limit < 8; ++limit) {
    Recorder recorder;
    recorder.limit = limit;
    const OptimizerResult r = minimise(problem, {1, 5, 5, 1}, recorder);
    double best = std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
    for (const OptimizerIterate& at : recorder.iterates) {
      least = std::min(least, at.constraint_violation);
      if (at.constraint_violation <= 1e-8) best = std::min(best, at.value);
    }
    if (std::isfinite(best)) {
      EXPECT_EQ(r.value, best);
    } else {
      EXPECT_NE(r.message.find("violated by up to " + std::to_string(least)), std::string::npos);
    }
    problem.evaluated.clear();
    problem.accepted.clear();
  }
}

TEST(SqpRobustness, StartOutsideItsBoundsIsRefused)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  Recorder recorder;
  EXPECT_THROW(Sqp({}).minimize(problem, std::vector<double>{-3.0, 0.0}, recorder), InputError);
  EXPECT_THROW(Sqp({}).minimize(problem, std::vector<double>{0.0}, recorder), InputError);
  EXPECT_TRUE(problem.evaluated.empty());
}

}  // namespace
}  // namespace hauberk
