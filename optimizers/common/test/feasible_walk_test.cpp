/// What a method that says no more than where to go gets, and what the problem sees of it. (That the walk
/// solves problems is seen by the template of optimizers, tests/consumer.)

#include <hauberk/conformance/known_problems.hpp>
#include <hauberk/kit/feasible_walk.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hauberk {
namespace {

using namespace conformance;
using kit::FeasibleWalk;

/// x0^2/2 + x1 within +-2, safe up to 0.5 along x0, with x0 >= 0.25 as its constraint.
FunctionProblem slope_with_a_wall()
{
  FunctionProblem p = box(2, -2.0, 2.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << x[0], 1.0;
    return 0.5 * x[0] * x[0] + x[1];
  };
  p.safe = [](const VectorXd&, const VectorXd& d) { return std::min(1.0, 0.5 / std::abs(d[0])); };
  p.constraint_number = 1;
  p.constraint_functions = [](const VectorXd& x, VectorXd& c, RowMajor& J) {
    c << x[0] - 0.25;
    J << 1.0, 0.0;
  };
  return p;
}

TEST(FeasibleWalk, GoesAsFarAsIsSafeAndAllowed)
{
  FunctionProblem problem = slope_with_a_wall();
  Recorder recorder;
  const std::vector<double> start{1.5, 0.0};
  FeasibleWalk walk(problem, start, recorder, {.memory = 1});
  ASSERT_TRUE(walk.going());
  EXPECT_EQ(walk.step(1.0), (std::vector<double>{-1.5, -1.0}));
  EXPECT_EQ(walk.step(3.0), (std::vector<double>{-3.5, -2.0}));  // onto the bounds
  EXPECT_EQ(walk.optimality(), 1.5);
  ASSERT_TRUE(walk.move({-1.0, 0.0}));  // half of it is safe
  EXPECT_EQ(walk.x(), (std::vector<double>{1.0, 0.0}));
  // A half is safe, and a fifth leaves x0 >= 0.25: x0 = 1 - 2 (0.25 of it is safe) 0.4.
  ASSERT_TRUE(walk.move({-2.0, 0.0}));
  EXPECT_DOUBLE_EQ(walk.x()[0], 0.5);
  ASSERT_TRUE(walk.move({-1.0, 0.0}));
  EXPECT_DOUBLE_EQ(walk.x()[0], 0.3);
  EXPECT_FALSE(walk.move({0.0, 1.0}));  // uphill
  EXPECT_EQ(walk.end().status, "small_step");
  EXPECT_EQ(walk.end().x, walk.x());
  EXPECT_EQ(walk.end().iterations, 3);
  EXPECT_EQ(recorder.iterates.size(), 4U);
  EXPECT_EQ(recorder.iterates[1].step, 0.5);
  EXPECT_EQ(problem.breach, "");
}

TEST(FeasibleWalk, EndsWhereItIsTold)
{
  const auto end_of = [](std::vector<double> start, const FeasibleWalk::Limits& limits, int observed,
                         FunctionProblem problem = slope_with_a_wall()) {
    Recorder recorder;
    recorder.limit = observed;
    FeasibleWalk walk(problem, start, recorder, limits);
    while (walk.going()) walk.move({-0.01, -0.1});
    EXPECT_EQ(problem.breach, "");
    EXPECT_FALSE(walk.move({-0.01, 0.0}));  // nothing is asked any more
    return walk.end();
  };
  constexpr int never = 1 << 30;
  EXPECT_EQ(end_of({1.5, 1.0}, {.iterations = 2}, never).message, "stopped after 2 iterations");
  EXPECT_EQ(end_of({1.5, 1.0}, {.evaluations = 3}, never).evaluations, 3);
  EXPECT_EQ(end_of({1.5, 1.0}, {}, 2).status, "stopped");
  EXPECT_EQ(end_of({1.5, 1.0}, {}, 1).iterations, 0);
  const OptimizerResult outside = end_of({0.0, 1.0}, {}, never);
  EXPECT_EQ(outside.status, "failed");
  EXPECT_NE(outside.message.find("constraints"), std::string::npos);
  EXPECT_EQ(outside.evaluations, 0);
  // A gradient that is none, at the iterate alone: not the end of a descent.
  FunctionProblem odd = slope_with_a_wall();
  odd.objective = [](const VectorXd& x, VectorXd& g) {
    g << std::numeric_limits<double>::quiet_NaN(), 1.0;
    return 0.5 * x[0] * x[0] + x[1];
  };
  EXPECT_EQ(end_of({1.5, 1.0}, {}, never, odd).status, "failed");
  EXPECT_TRUE(std::isnan(kit::largest(std::vector{1.0, std::numeric_limits<double>::quiet_NaN(), 2.0})));
  EXPECT_EQ(kit::largest(std::vector{1.0, -3.0, 2.0}), 3.0);
  FunctionProblem failing = slope_with_a_wall();
  failing.fails = [](const VectorXd&) { return true; };
  EXPECT_EQ(end_of({1.5, 1.0}, {}, never, failing).status, "failed");
}

}  // namespace
}  // namespace hauberk
