/// Evaluations of a batch are those of its points one by one, whatever their order and the number of threads.

#include "uneven_chainmail.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk::test {
namespace {

using Evaluation = OptimizationProblem::Evaluation;
using Points = std::vector<std::vector<double>>;

/// Points around the start: one twice, and one whose rings collide.
Points around(const std::vector<double>& x)
{
  Points points(4, x);
  points[0][0] += 0.02;
  points[1][3] -= 0.03;
  points[2][1] = points[2][3] = 1.4;
  points[2][0] = points[2][2] = 4.0;
  points[3] = points[0];
  return points;
}

std::vector<Evaluation> in_a_batch(DesignProblem& problem, const Points& points)
{
  std::vector<double> rows;
  for (const std::vector<double>& x : points) rows.insert(rows.end(), x.begin(), x.end());
  return problem.evaluate_batch(points.size(), rows, true);
}

void expect_same(const std::vector<Evaluation>& a, const std::vector<Evaluation>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].ok, b[i].ok) << i;
    EXPECT_EQ(a[i].value, b[i].value) << i;
    EXPECT_EQ(a[i].gradient, b[i].gradient) << i;
    EXPECT_EQ(a[i].why, b[i].why) << i;
  }
}

TEST(DesignBatches, AreTheirPointsOneByOne)
{
  AtStart single;
  const Points points = around(single.x);
  std::vector<Evaluation> expected;
  for (const std::vector<double>& x : points) expected.push_back(single.problem.evaluate(x, true));
  EXPECT_TRUE(expected[0].ok && expected[1].ok && !expected[2].ok);
  EXPECT_NE(expected[0].value, expected[1].value);

  Points backwards(points.rbegin(), points.rend());
  std::vector<Evaluation> expected_backwards(expected.rbegin(), expected.rend());
  AtStart batch(spec(), 3), other(spec(), 1);
  expect_same(in_a_batch(batch.problem, points), expected);
  expect_same(in_a_batch(other.problem, backwards), expected_backwards);
  EXPECT_EQ(batch.problem.evaluations(), single.problem.evaluations());
  // Any of them may be accepted; what follows is the same.
  single.problem.accept(points[1]);
  batch.problem.accept(points[1]);
  expect_same({batch.problem.evaluate(points[0], true)}, {single.problem.evaluate(points[0], true)});
}

TEST(DesignBatches, TheStartIsEvaluatedBeforeWhatFollowsItsStates)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  const DesignSpec design = spec();
  AtStart first;
  const Points points{around(first.x)[0], first.x};
  const Evaluation expected = first.problem.evaluate(points[0], true);
  DesignProblem problem({scene, load, 0.0, LimitSettings{}, design, 2, [] { return true; }});
  expect_same({in_a_batch(problem, points)[0]}, {expected});
}

}  // namespace
}  // namespace hauberk::test
