/// How populations are made to keep the contract. What every optimizer must do is checked in
/// common/test/conformance_test.cpp.

#include "../candidates.hpp"
#include "../pagmo_optimizer.hpp"

#include <hauberk/conformance/known_problems.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk {
namespace {

using namespace conformance;

/// A walk that has begun, and what pagmo sees of it.
struct Begun {
  Begun(FunctionProblem& problem, const std::vector<double>& start) : walk(problem, {}, recorder, start)
  {
    std::string why;
    EXPECT_TRUE(walk.begin(false, why)) << why;
  }
  double fitness(const pagmo::vector_double& z) { return Candidates(walk).fitness(z)[0]; }
  Recorder recorder;
  Walk walk;
};

/// -3 x0 - 4 x1 within the unit disk, ranges of 4.
TEST(Candidates, AreInTheOrderOfDebsRules)
{
  FunctionProblem problem = farthest_in_disk(2.0);
  problem.fails = [](const VectorXd& x) { return x[0] < -0.9; };
  Begun b(problem, {0.1, 0.0});
  const double unit = 0.3;
  EXPECT_EQ(b.fitness({0.0, 0.0}), 0.0);
  EXPECT_NEAR(b.fitness({0.0, -0.25}), 4.0 / unit, 1e-12);  // on the circle, and bad
  // Outside by different amounts, and better than any point inside: behind all of them.
  const double near = b.fitness({0.3, 0.2}), far = b.fitness({0.5, 0.5}), never = b.fitness({-0.24, 0.0});
  EXPECT_GT(near, 1e50);
  EXPECT_GT(far, near);
  EXPECT_GT(never, far);
  EXPECT_EQ(problem.accepted.size(), 1U);
  EXPECT_EQ(problem.evaluated.size(), 4U);  // two are outside, and not evaluated
}

TEST(Candidates, TheBestSoFarIsAcceptedAndTheNextIsReachedFromThere)
{
  FunctionProblem problem = farthest_in_disk(2.0);
  problem.safe = [](const VectorXd&, const VectorXd& d) { return std::min(1.0, 0.5 / d.norm()); };
  Begun b(problem, {0.0, 0.0});
  EXPECT_EQ(b.fitness({0.0, 0.2}), Candidates::unreachable);  // 0.8 away
  EXPECT_EQ(problem.evaluated.size(), 1U);
  EXPECT_EQ(b.fitness({0.0, 0.1}), -1.6);  // 0.4 away
  EXPECT_EQ(problem.accepted.size(), 2U);
  EXPECT_EQ(b.fitness({0.0, 0.2}), -3.2);
  EXPECT_EQ(problem.accepted.size(), 3U);
  EXPECT_EQ(problem.breach, "");
}

TEST(Candidates, KnowOnlyFreeVariables)
{
  FunctionProblem problem = farthest_in_disk(2.0);
  problem.lower_bounds[0] = problem.upper_bounds[0] = 0.5;
  Begun b(problem, {0.5, 0.0});
  const Candidates candidates(b.walk);
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_EQ(candidates.get_bounds().first, pagmo::vector_double{-0.5});
  b.fitness({0.1});
  EXPECT_EQ(problem.evaluated.back(), Eigen::Vector2d(0.5, 0.4));
}

struct Trace {
  OptimizerResult result;
  std::vector<VectorXd> evaluated;
};

Trace run(unsigned seed)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  PagmoSettings settings;
  settings.seed = seed;
  settings.generations = 1000;
  settings.walk.tolerance = 1e-10;
  Recorder recorder;
  Trace t;
  t.result = PagmoOptimizer(settings).minimize(problem, std::vector<double>{-1.2, 1.0}, recorder);
  t.evaluated = problem.evaluated;
  EXPECT_EQ(problem.breach, "");
  return t;
}

TEST(Pagmo, TheSeedIsAllThatDrawsDependOn)
{
  const Trace a = run(1), b = run(1), other = run(2);
  EXPECT_EQ(a.evaluated, b.evaluated);
  EXPECT_EQ(a.result.x, b.result.x);
  EXPECT_NE(a.evaluated, other.evaluated);
  for (const Trace* t : {&a, &other}) EXPECT_NEAR(t->result.value, 0.0, 1e-8) << t->result.message;
}

TEST(Pagmo, SaysThatItsGenerationsAreOver)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  PagmoSettings settings;
  settings.generations = 3;
  Recorder recorder;
  const OptimizerResult r =
      PagmoOptimizer(settings).minimize(problem, std::vector<double>{-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "iteration_limit");
  EXPECT_EQ(r.message, "stopped after 3 generations");
}

}  // namespace
}  // namespace hauberk
