/// How NLopt is made to keep the contract. The known problems are solved in common/test/conformance_test.cpp.

#include "../adapter.hpp"

#include <hauberk/conformance/known_problems.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk {
namespace {

using namespace conformance;

/// An adapter for a problem within [0, 10] or so, begun at its start.
struct Begun {
  Begun(FunctionProblem& problem, const std::vector<double>& start, const NloptSettings& settings = {})
      : adapter(problem, settings, recorder, start)
  {
    std::string why;
    EXPECT_TRUE(adapter.begin(why)) << why;
  }
  Recorder recorder;
  NloptAdapter adapter;
};

/// x0^2 + x1 over ranges of 4, from (2, 0): unit 4.
FunctionProblem bowl()
{
  FunctionProblem p = box(2, -2.0, 2.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << 2.0 * x[0], 1.0;
    return x[0] * x[0] + x[1];
  };
  return p;
}

TEST(NloptAdapter, ScalesVariablesAndObjective)
{
  FunctionProblem problem = bowl();
  Begun b(problem, {2.0, 0.0});
  EXPECT_EQ(b.adapter.unit(), 4.0);
  const Eigen::Vector2d z(0.25, 0.0);
  Eigen::Vector2d gradient;
  EXPECT_EQ(b.adapter.objective(z.data(), gradient.data()), 0.25);  // (1^2 + 0)/4
  EXPECT_EQ(gradient, Eigen::Vector2d(2.0, 1.0));                   // (2, 1) * 4/4
  EXPECT_EQ(problem.accepted.size(), 2U);
}

TEST(NloptAdapter, EvaluatesAPointOnce)
{
  FunctionProblem problem = hs71();
  Begun b(problem, {1, 5, 5, 1});
  const Eigen::Vector4d z = Eigen::Vector4d(1, 4, 4, 1) / 4.0;
  Eigen::Vector4d gradient;
  Eigen::Vector3d c;
  b.adapter.constraints(z.data(), 0, 3, c.data(), nullptr);
  const double value = b.adapter.objective(z.data(), gradient.data());
  EXPECT_EQ(b.adapter.objective(z.data(), nullptr), value);
  EXPECT_EQ(c, Eigen::Vector3d(9.0, 6.0, -6.0));  // -c: the sign of NLopt
  EXPECT_LE(problem.evaluated.size(), 3U);        // the first question was without a gradient
}

TEST(NloptAdapter, AnUnsafePointIsAWallThatIsNotEvaluated)
{
  FunctionProblem problem = bowl();
  problem.safe = [](const VectorXd&, const VectorXd& d) { return d[0] < 0.0 ? 0.5 : 1.0; };
  Begun b(problem, {2.0, 0.0});
  const Eigen::Vector2d z(0.25, 0.0);
  Eigen::Vector2d gradient;
  EXPECT_EQ(b.adapter.objective(z.data(), gradient.data()), 2.0);  // the worst that was seen, and one unit
  EXPECT_EQ(gradient, Eigen::Vector2d(-4.0, 0.0));                 // rises away from the accepted point
  EXPECT_EQ(problem.evaluated.size(), 1U);
  EXPECT_TRUE(b.adapter.walk().blocked());
  EXPECT_EQ(problem.accepted.size(), 1U);
}

TEST(NloptAdapter, AFailedEvaluationIsAWallWithLinearisedConstraints)
{
  FunctionProblem problem = hs71();
  problem.fails = [](const VectorXd& x) { return x[0] > 1.5; };
  Begun b(problem, {1, 5, 5, 1});
  const double start = b.adapter.merit();
  const Eigen::Vector4d z = Eigen::Vector4d(2, 5, 5, 1) / 4.0;
  Eigen::Vector3d c;
  EXPECT_EQ(b.adapter.objective(z.data(), nullptr), 2.0);
  b.adapter.constraints(z.data(), 0, 3, c.data(), nullptr);
  // c = (0, 12, -12) and its slopes (25, 2, -2) at the start, times 1, with NLopt's sign.
  EXPECT_NEAR((c - Eigen::Vector3d(-25.0, -14.0, 14.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(b.adapter.merit(), start);
  EXPECT_FALSE(b.adapter.walk().blocked());
}

TEST(NloptAdapter, AcceptsWhatIsBetterOnly)
{
  FunctionProblem problem = bowl();
  Begun b(problem, {1.0, 0.0});
  const Eigen::Vector2d worse(0.5, 0.0), better(0.0, 0.0);
  b.adapter.objective(worse.data(), nullptr);
  EXPECT_EQ(problem.accepted.size(), 1U);
  b.adapter.objective(better.data(), nullptr);
  EXPECT_EQ(problem.accepted.size(), 2U);
  EXPECT_EQ(b.recorder.iterates.back().value, 0.0);
  EXPECT_EQ(b.recorder.iterates.back().step, 0.25);
}

TEST(NloptAdapter, NothingIsAskedAfterAStop)
{
  FunctionProblem problem = bowl();
  Begun b(problem, {1.0, 0.0});
  b.recorder.limit = 2;
  const Eigen::Vector2d better(0.0, 0.0), best(0.0, -0.25);
  b.adapter.objective(better.data(), nullptr);
  EXPECT_TRUE(b.adapter.stopped());
  b.adapter.objective(best.data(), nullptr);
  EXPECT_EQ(problem.evaluated.size(), 2U);
}

TEST(NloptAdapter, NotANumberIsAWall)
{
  FunctionProblem problem = bowl();
  Begun b(problem, {1.0, 0.0});
  const Eigen::Vector2d z(std::nan(""), 0.0);
  Eigen::Vector2d gradient;
  EXPECT_EQ(b.adapter.objective(z.data(), gradient.data()), 2.0);
  EXPECT_EQ(gradient, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(problem.evaluated.size(), 1U);
}

TEST(Nlopt, WhatNloptRefusesIsAFailureWithItsReason)
{
  FunctionProblem problem = bowl();
  NloptSettings settings;
  settings.algorithm = NloptAlgorithm::cobyla;
  settings.initial_step = std::nan("");
  Recorder recorder;
  const OptimizerResult r =
      NloptOptimizer(settings).minimize(problem, std::vector<double>{1.0, 0.5}, recorder);
  EXPECT_EQ(r.status, "failed");
  EXPECT_NE(r.message.find("INVALID_ARGS, invalid scaling"), std::string::npos) << r.message;
  EXPECT_EQ(r.x, (std::vector<double>{1.0, 0.5}));
  EXPECT_EQ(r.value, 1.5);
}

TEST(Nlopt, AMethodThatGivesUpAtAKinkHasNotFailed)
{
  FunctionProblem problem = box(2, -2.0, 2.0);
  problem.objective = [](const VectorXd& x, VectorXd& g) {
    g << (x[0] < 0.3 ? -1.0 : 1.0), (x[1] < -0.4 ? -3.0 : 3.0);
    return std::abs(x[0] - 0.3) + 3.0 * std::abs(x[1] + 0.4);
  };
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::slsqp, NloptAlgorithm::lbfgs}) {
    NloptSettings settings;
    settings.algorithm = algorithm;
    Recorder recorder;
    const OptimizerResult r =
        NloptOptimizer(settings).minimize(problem, std::vector<double>{1.7, 1.1}, recorder);
    EXPECT_EQ(r.status, "small_step") << r.message;
    EXPECT_LT(r.value, 5.9);
  }
}

TEST(Nlopt, ResultIsFeasibleAlsoWhereTheMethodComesFromOutside)
{
  // The augmented Lagrangian ends slightly beyond the disk.
  FunctionProblem problem = farthest_in_disk(2.0);
  NloptSettings settings;
  settings.algorithm = NloptAlgorithm::lbfgs;
  Recorder recorder;
  const OptimizerResult r =
      NloptOptimizer(settings).minimize(problem, std::vector<double>{0.1, -0.3}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_LE(std::hypot(r.x[0], r.x[1]), 1.0 + 1e-8);
  EXPECT_NEAR(r.value, -5.0, 1e-5);
}

/// Walls all around the start: mma and ccsaq can ask for such points for ever.
TEST(NloptOptimizer, EndsWhereNothingCanBeReached)
{
  for (const NloptAlgorithm algorithm : {NloptAlgorithm::slsqp, NloptAlgorithm::mma, NloptAlgorithm::ccsaq,
                                         NloptAlgorithm::lbfgs, NloptAlgorithm::cobyla}) {
    FunctionProblem problem = bowl();
    problem.safe = [](const VectorXd&, const VectorXd&) { return 0.5; };
    NloptSettings settings;
    settings.algorithm = algorithm;
    Recorder recorder;
    const std::vector<double> start{1.5, 1.0};
    const OptimizerResult result = NloptOptimizer(settings).minimize(problem, start, recorder);
    EXPECT_EQ(result.status, "small_step");
    EXPECT_EQ(result.x, start);
    EXPECT_LE(result.evaluations, 2);
  }
}

}  // namespace
}  // namespace hauberk
