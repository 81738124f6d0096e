/// Known optima, and what they cost.

#include "../sqp.hpp"

#include <hauberk/conformance/known_problems.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace hauberk {
namespace {

using namespace conformance;

SqpSettings accurate()
{
  SqpSettings settings;
  settings.tolerance = 1e-10;
  return settings;
}

OptimizerResult minimise(FunctionProblem& problem, const std::vector<double>& start, Recorder& recorder,
                         const SqpSettings& settings = accurate())
{
  OptimizerResult result = Sqp(settings).minimize(problem, start, recorder);
  EXPECT_EQ(problem.breach, "");
  EXPECT_EQ(result.evaluations, static_cast<int>(problem.evaluated.size()));
  EXPECT_EQ(recorder.iterates.size(), static_cast<std::size_t>(result.iterations) + 1);
  return result;
}

TEST(SqpConvergence, RosenbrockInsideBounds)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "converged");
  EXPECT_NEAR(r.x[0], 1.0, 1e-5);
  EXPECT_NEAR(r.x[1], 1.0, 1e-5);
  EXPECT_LT(r.evaluations, 70);
  EXPECT_EQ(recorder.iterates[0].step, 0.0);
  EXPECT_LE(recorder.iterates[1].step, 0.05 + 1e-12);  // initial_step
}

TEST(SqpConvergence, RosenbrockOnItsBound)
{
  // With x1 <= 0.5 the valley is left at (0.5, 0.25).
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  problem.upper_bounds[0] = 0.5;
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "converged");
  EXPECT_EQ(r.x[0], 0.5);
  EXPECT_NEAR(r.x[1], 0.25, 1e-6);
  EXPECT_NEAR(r.value, 0.25, 1e-9);
}

TEST(SqpConvergence, RosenbrockOnADisk)
{
  // x.x <= 2 touches the minimum (1, 1): a constraint that is active with multiplier zero.
  FunctionProblem problem = rosenbrock(-1.5, 1.5);
  problem.constraint_number = 1;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << 2.0 - x.squaredNorm();
    J.row(0) = -2.0 * x;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-0.5, 0.5}, recorder);
  EXPECT_EQ(r.status, "converged");
  EXPECT_NEAR(r.x[0], 1.0, 1e-4);
  EXPECT_NEAR(r.x[1], 1.0, 1e-4);
}

TEST(SqpConvergence, HockSchittkowski71)
{
  FunctionProblem problem = hs71();
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {1, 5, 5, 1}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.value, 17.0140173, 1e-6);
  EXPECT_NEAR(r.x[0], 1.0, 1e-9);
  EXPECT_NEAR(r.x[1], 4.7429994, 1e-5);
  EXPECT_NEAR(r.x[2], 3.8211503, 1e-5);
  EXPECT_NEAR(r.x[3], 1.3794082, 1e-5);
  EXPECT_LT(r.evaluations, 25);
  EXPECT_LT(recorder.iterates.back().constraint_violation, 1e-8);
}

TEST(SqpConvergence, HockSchittkowski76)
{
  FunctionProblem problem = hs76();
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {0.5, 0.5, 0.5, 0.5}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.value, -4.681818181818, 1e-8);
  EXPECT_LT(r.evaluations, 30);
}

TEST(SqpConvergence, InfeasibleStartOfACurvedProblem)
{
  // min x + y on the outside of the unit disk, inside a box: a corner; start in the disk.
  FunctionProblem problem = box(2, -0.9, 3.0);
  problem.objective = [](const VectorXd& x, VectorXd& g) {
    g.setOnes();
    return x.sum();
  };
  problem.constraint_number = 1;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x.squaredNorm() - 1.0;
    J.row(0) = 2.0 * x;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {0.2, 0.1}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_GE(r.x[0] * r.x[0] + r.x[1] * r.x[1], 1.0 - 1e-8);
  EXPECT_GT(recorder.iterates.front().constraint_violation, 0.9);
}

TEST(SqpConvergence, MaratosEffect)
{
  // Powell's example: full steps along the circle violate it to second order; the correction takes them.
  FunctionProblem problem = box(2, -2.0, 2.0);
  problem.objective = [](const VectorXd& x, VectorXd& g) {
    g << 4.0 * x[0] - 1.0, 4.0 * x[1];
    return 2.0 * (x.squaredNorm() - 1.0) - x[0];
  };
  problem.constraint_number = 2;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x.squaredNorm() - 1.0, 1.0 - x.squaredNorm();
    J.row(0) = 2.0 * x;
    J.row(1) = -2.0 * x;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {0.8, 0.6}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.x[0], 1.0, 1e-8);
  EXPECT_NEAR(r.value, -1.0, 1e-8);
  EXPECT_LT(r.evaluations, 25);
}

TEST(SqpConvergence, DegenerateVertexWithDependentConstraints)
{
  // Five constraints meet at the optimum (1, 1), one of them twice.
  FunctionProblem problem = box(2, 0.0, 4.0);
  problem.objective = [](const VectorXd& x, VectorXd& g) {
    g = 2.0 * x;
    return x.squaredNorm();
  };
  problem.constraint_number = 5;
  problem.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    J << 1, 0, 0, 1, 1, 1, 1, 1, 3, 1;
    c = J * x;
    c[0] -= 1.0;
    c[1] -= 1.0;
    c[2] -= 2.0;
    c[3] -= 2.0;
    c[4] -= 4.0;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {3.0, 2.5}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.x[0], 1.0, 1e-8);
  EXPECT_NEAR(r.x[1], 1.0, 1e-8);
}

TEST(SqpConvergence, ScaleOfVariablesDoesNotMatter)
{
  // The same problem in other units takes the same iterates.
  FunctionProblem metres = rosenbrock(-2.0, 2.0);
  FunctionProblem micrometres = rosenbrock_in_units(1e-6);
  Recorder first, second;
  const OptimizerResult a = minimise(metres, {-1.2, 1.0}, first);
  const OptimizerResult b = minimise(micrometres, {-1.2e6, 1.0e6}, second);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_NEAR(b.x[0], 1e6 * a.x[0], 1.0);
}

TEST(SqpConvergence, FixedAndUnboundedVariables)
{
  FunctionProblem problem = rosenbrock(-1e300, 1e300);
  problem.lower_bounds = {-1.0, -std::numeric_limits<double>::infinity()};
  problem.upper_bounds = {-1.0, std::numeric_limits<double>::infinity()};
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.0, 7.0}, recorder);
  EXPECT_EQ(r.status, "converged");
  EXPECT_EQ(r.x[0], -1.0);
  EXPECT_NEAR(r.x[1], 1.0, 1e-5);
}

/// Eight residuals of 24 variables, as designs are; all vanish at one point.
void eight_residuals(const VectorXd& x, VectorXd& r, RowMajor& J)
{
  r.setZero(8);
  J.resize(8, 24);
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < 24; ++i) {
      const double weight = 0.1 * (0.5 + 0.5 * std::cos(1.0 + k * (i + 1.3)));
      const double target = 0.3 + 0.025 * ((5 * i) % 24);
      r[k] += weight * (x[i] - target + 0.3 * (x[i] * x[i] - target * target));
      J(k, i) = weight * (1.0 + 0.6 * x[i]);
    }
  }
}

TEST(SqpConvergence, ManyLeastSquaresVariables)
{
  // Far fewer evaluations than variables squared.
  FunctionProblem problem = sum_of_squares(box(24, 0.0, 1.0), 8, eight_residuals, false);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, std::vector<double>(24, 0.3), recorder, SqpSettings{});
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_LT(r.value, 1e-4 * recorder.iterates.front().value);
  EXPECT_LT(r.evaluations, 60);
}

TEST(SqpConvergence, ResidualsSaveEvaluations)
{
  FunctionProblem problem = sum_of_squares(box(24, 0.0, 1.0), 8, eight_residuals, true);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, std::vector<double>(24, 0.3), recorder, SqpSettings{});
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_LT(r.value, 1e-4 * recorder.iterates.front().value);
  EXPECT_LT(r.evaluations, 15);
}

TEST(SqpConvergence, UselessJacobianEnds)
{
  // Jacobians of residuals that are nought, and ten times too small: steps are shortened, and the run ends.
  for (const double factor : {0.0, 0.1}) {
    FunctionProblem problem = rosenbrock(-2.0, 2.0);
    problem.residual_number = 2;
    problem.residual_functions = [factor](const VectorXd& x, VectorXd& r, RowMajor& J) {
      const double root = std::sqrt(2.0);
      r << root * (1.0 - x[0]), root * 10.0 * (x[1] - x[0] * x[0]);
      J << -root, 0.0, -20.0 * root * x[0], 10.0 * root;
      J *= factor;
    };
    Recorder recorder;
    const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder, SqpSettings{});
    EXPECT_LT(r.value, 24.3);
    EXPECT_LE(r.iterations, 100);
    EXPECT_LT(r.evaluations, 1300);
  }
}

TEST(SqpConvergence, KinkedResidualsAreFollowedAlongTheirKinks)
{
  FunctionProblem problem = sum_of_squares(box(6, -2.0, 3.0), 12, kinked_residuals, true);
  const std::vector<double> start = {-1.0, 2.0, 0.3, -0.7, 1.4, 0.1};
  const double t = 1.4 / (1.96 + 0.25);
  const double least = 3.0 * ((1.4 * t - 1.0) * (1.4 * t - 1.0) + 0.25 * t * t);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, start, recorder, SqpSettings{});
  EXPECT_NEAR(r.value, least, 1e-6 * least);
  for (const double v : r.x) EXPECT_NEAR(v, t, 1e-3);
  // Without residuals the search sees one gradient at a time.
  FunctionProblem blind = sum_of_squares(box(6, -2.0, 3.0), 12, kinked_residuals, false);
  Recorder other;
  const OptimizerResult slow = minimise(blind, start, other, SqpSettings{});
  EXPECT_GE(slow.value, r.value - 1e-9);
  EXPECT_LT(2 * r.evaluations, slow.evaluations);
}

TEST(SqpConvergence, AJumpIsCrossed)
{
  // Along the way down to x = 0 the residual jumps up by 10 % at x = 1.
  const auto residual = [](const VectorXd& x, VectorXd& r, RowMajor& J) {
    r << x[0] + (x[0] < 1.0 && x[0] > -0.5 ? 0.1 : 0.0), 0.1 * (x[1] - 1.0);
    J << 1.0, 0.0, 0.0, 0.1;
  };
  FunctionProblem problem = sum_of_squares(box(2, -4.0, 4.0), 2, residual, true);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {1.05, -3.0}, recorder, SqpSettings{});
  EXPECT_LT(r.value, 1e-6 * recorder.iterates.front().value) << r.message;
  EXPECT_NEAR(r.x[0], -0.1, 2e-3);
}

/// A problem that looks at its iterates more closely than at trials: every third one is then worth more.
class CloserLook final : public FunctionProblem {
 public:
  double found = 0.0;

  void accept(std::span<const double> x) override
  {
    FunctionProblem::accept(x);
    if (accepted.size() % 3 == 0) found += 0.01;
  }
};

TEST(SqpConvergence, WhatACloserLookAtAnIterateFindsIsTaken)
{
  CloserLook problem;
  problem.lower_bounds = {-4.0, -4.0};
  problem.upper_bounds = {4.0, 4.0};
  problem.objective = [&problem](const VectorXd& x, VectorXd& g) {
    g = 2.0 * (x - VectorXd::Ones(2)) + VectorXd{{4.0 * x[0] * x[0] * x[0], 0.0}};
    return (x - VectorXd::Ones(2)).squaredNorm() + x[0] * x[0] * x[0] * x[0] + problem.found;
  };
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-3.0, -2.0}, recorder, SqpSettings{});
  EXPECT_EQ(r.status, "converged") << r.message;
  ASSERT_GT(problem.found, 0.0);
  VectorXd g(2);
  ASSERT_EQ(problem.accepted.size(), recorder.iterates.size());
  const double found = std::exchange(problem.found, 0.0);
  for (std::size_t k = 0; k < problem.accepted.size(); ++k) {
    const double looks = std::floor(static_cast<double>(k + 1) / 3.0);
    EXPECT_NEAR(recorder.iterates[k].value, problem.objective(problem.accepted[k], g) + 0.01 * looks, 1e-12)
        << k;
    EXPECT_LE(0.01 * looks, found + 1e-12);
  }
}

}  // namespace
}  // namespace hauberk
