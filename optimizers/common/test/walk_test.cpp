/// What a library that asks for values anywhere gets, and what the problem sees of it.

#include <common/walk.hpp>

#include <hauberk/conformance/known_problems.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk {
namespace {

using namespace conformance;
using Eigen::Vector2d;

/// A walk that has begun.
struct Begun {
  Begun(FunctionProblem& problem, const std::vector<double>& start, const WalkSettings& settings = {})
      : walk(problem, settings, recorder, start)
  {
    std::string why;
    EXPECT_TRUE(walk.begin(true, why)) << why;
  }
  Recorder recorder;
  Walk walk;
};

/// x0^2 + x1 over ranges of 4, safe up to a distance of 0.5 along x0.
FunctionProblem bowl(int& asked)
{
  FunctionProblem p = box(2, -2.0, 2.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << 2.0 * x[0], 1.0;
    return x[0] * x[0] + x[1];
  };
  p.safe = [&asked](const VectorXd&, const VectorXd& d) {
    ++asked;
    return std::min(1.0, 0.5 / std::abs(d[0]));
  };
  return p;
}

TEST(Walk, LooksOnlyAtWhatIsSafeFromTheAcceptedPoint)
{
  int asked = 0;
  FunctionProblem problem = bowl(asked);
  Begun b(problem, {2.0, 0.0});
  EXPECT_FALSE(b.walk.look(Vector2d(0.0, 0.0), true).ok);
  EXPECT_TRUE(b.walk.blocked());
  EXPECT_FALSE(b.walk.look(Vector2d(1.0, 0.0), true).ok);
  EXPECT_EQ(asked, 1);  // the second is known to be on the same ray, and too far
  EXPECT_FALSE(b.walk.look(Vector2d(1.0, 0.1), true).ok);
  EXPECT_EQ(asked, 2);  // another ray
  EXPECT_EQ(problem.evaluated.size(), 1U);
  for (const double x : {1.5, 1.0}) {
    const Walk::Place& place = b.walk.look(Vector2d(x, 0.0), true);
    ASSERT_TRUE(place.ok);
    EXPECT_EQ(place.value, x * x);
    EXPECT_EQ(place.at.gradient, Vector2d(8.0 * x, 4.0));  // times the range
    b.walk.accept_last();
  }
  EXPECT_EQ(problem.accepted.size(), 3U);
  EXPECT_EQ(b.recorder.iterates.back().step, 0.125);
  EXPECT_EQ(b.walk.best().x(), Vector2d(1.0, 0.0));
  EXPECT_EQ(problem.breach, "");
}

TEST(Walk, ReturnsToTheBestPointWhereTheWayIsSafe)
{
  int asked = 0;
  FunctionProblem problem = bowl(asked);
  Begun b(problem, {1.0, 0.0});
  for (const double x : {1.5, 2.0}) {
    ASSERT_TRUE(b.walk.look(Vector2d(x, 0.0), true).ok);
    b.walk.accept_last();
  }
  b.walk.return_to_best();  // 1 away
  EXPECT_EQ(b.walk.accepted().x, Vector2d(2.0, 0.0));
  ASSERT_TRUE(b.walk.look(Vector2d(1.5, 0.0), true).ok);
  b.walk.accept_last();
  b.walk.return_to_best();
  EXPECT_EQ(b.walk.accepted().x, Vector2d(1.0, 0.0));
  EXPECT_EQ(b.walk.finish("small_step", "").x, (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(problem.breach, "");
}

TEST(Walk, NothingIsEvaluatedAfterAStop)
{
  int asked = 0;
  FunctionProblem problem = bowl(asked);
  WalkSettings settings;
  settings.max_evaluations = 2;
  Begun b(problem, {1.0, 0.0}, settings);
  EXPECT_TRUE(b.walk.look(Vector2d(0.9, 0.0), false).ok);
  EXPECT_FALSE(b.walk.look(Vector2d(0.8, 0.0), false).ok);
  EXPECT_EQ(b.walk.stopped(), Walk::Stop::evaluations);
  EXPECT_EQ(b.walk.finish_stopped().message, "stopped after 2 evaluations");
  EXPECT_EQ(problem.evaluated.size(), 2U);
}

TEST(Walk, RestoresOntoTheConstraintsByNewtonsMethod)
{
  FunctionProblem problem = farthest_in_disk(2.0);
  Begun b(problem, {1.2, 1.6});  // at 2, twice the radius: 2, 1.25, 1.025, 1.0003, 1 + 4.6e-8, 1
  b.walk.restore();
  EXPECT_NEAR(b.walk.accepted().x.norm(), 1.0, 1e-8);
  EXPECT_EQ(b.walk.iterations(), 5);
  EXPECT_TRUE(b.walk.best().feasible());
  EXPECT_NEAR(b.walk.best().value(), -5.0, 1e-7);
  EXPECT_TRUE(b.walk.critical());
}

TEST(Walk, LooksAtSeveralPlacesAndAcceptsOne)
{
  int asked = 0;
  FunctionProblem problem = bowl(asked);
  WalkSettings settings;
  settings.max_evaluations = 4;
  Begun b(problem, {1.0, 0.0}, settings);
  const std::vector<Walk::Place> places =
      b.walk.look({Vector2d(0.75, 0.0), Vector2d(1.0, 0.0), Vector2d(-1.0, 0.0), Vector2d(0.5, 0.0),
                   Vector2d(0.9, 0.0), Vector2d(0.8, 0.0)},
                  true);
  EXPECT_TRUE(places[0].ok && places[1].ok && places[3].ok && places[4].ok);
  EXPECT_FALSE(places[2].ok);  // 2 away: not safe
  EXPECT_FALSE(places[5].ok);  // beyond the budget
  EXPECT_EQ(b.walk.stopped(), Walk::Stop::evaluations);
  EXPECT_EQ(problem.evaluated.size(), 4U);
  EXPECT_EQ(places[3].at.gradient, Vector2d(4.0, 4.0));
  b.walk.accept(places[3]);
  EXPECT_EQ(b.walk.accepted().x, Vector2d(0.5, 0.0));
  EXPECT_EQ(b.walk.best().value(), 0.25);
  EXPECT_EQ(problem.breach, "");
}

TEST(Walk, RestoresVariablesWithoutBounds)
{
  KnownProblem k = known_problem("hs6");
  Begun b(k.problem, {1.0, 1.001});
  b.walk.restore();
  EXPECT_TRUE(b.walk.best().feasible());
}

TEST(Walk, EquationsAreViolatedOnBothSides)
{
  FunctionProblem problem = hs71_equation();
  Begun b(problem, {1, 5, 5, 1});  // c = (12, 0)
  EXPECT_EQ(b.recorder.iterates.back().constraint_violation, 12.0);
  EXPECT_FALSE(b.walk.best().feasible());
  b.walk.restore();
  EXPECT_NEAR(b.walk.accepted().x.squaredNorm(), 40.0, 1e-7);
}

}  // namespace
}  // namespace hauberk
