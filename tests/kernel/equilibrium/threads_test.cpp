/// Threads share the pairs of a large scene; what they find is the same to the last bit.

#include "equilibrium/gaps.hpp"
#include "equilibrium/newton.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

/// 200 rings, so that the Hessian is sparse and pairs are advanced together.
class LargeScene : public testing::TestWithParam<unsigned> {
 protected:
  LargeScene() : model(make_model(chainmail(10, 10), load, 0.01)), state(rest_state(model))
  {
    std::mt19937_64 rng(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (Eigen::Index k = 0; k < state.e.size(); ++k) state.e[k] += 0.01 * uniform(rng);
    dy = Vector::Zero(model.dofs());
    for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = 0.3 * uniform(rng);
    dy.head(3) << 0.2, -0.1, 0.05;
  }

  ContactEnergy energy(unsigned threads) const
  {
    Stage stage;
    stage.contact = {Formulation::nearest, 0.1, model.clearance};
    stage.contact.threads = threads;
    Request request;
    request.order = 2;
    request.points = request.parameters = true;
    return contact_energy(model, state, stage_pairs(model, state, stage), stage.contact, request);
  }

  Sheet load{3};
  Model model;
  State state;
  Vector dy;
};

TEST_P(LargeScene, EnergyIsThatOfOneThread)
{
  const ContactEnergy one = energy(1), some = energy(GetParam());
  ASSERT_GT(one.points.size(), 300U);
  ASSERT_GT(one.sparse_hessian.nonZeros(), 10000);
  EXPECT_EQ(some.energy, one.energy);
  EXPECT_EQ(some.min_gap, one.min_gap);
  EXPECT_EQ(some.regularity, one.regularity);
  EXPECT_EQ(some.evaluations, one.evaluations);
  EXPECT_EQ(some.gradient, one.gradient);
  EXPECT_EQ(Matrix(some.sparse_hessian), Matrix(one.sparse_hessian));
  EXPECT_EQ(some.parameters, one.parameters);
  EXPECT_EQ(some.d_clearance, one.d_clearance);
  ASSERT_EQ(some.points.size(), one.points.size());
  for (std::size_t k = 0; k < one.points.size(); ++k) {
    EXPECT_EQ(some.points[k].a, one.points[k].a);
    EXPECT_EQ(some.points[k].image, one.points[k].image);
    EXPECT_EQ(some.points[k].contact.on_p, one.points[k].contact.on_p);
  }
}

TEST_P(LargeScene, SafeStepIsThatOfOneThread)
{
  const SafeStep one = largest_safe_step(model, state, dy, 0.1, 1);
  const SafeStep some = largest_safe_step(model, state, dy, 0.1, GetParam());
  EXPECT_GT(one.alpha, 0.0);
  EXPECT_LT(one.alpha, 1.0);
  EXPECT_GT(one.tight_pairs, 64);  // more than are taken together
  EXPECT_EQ(some.alpha, one.alpha);
  EXPECT_EQ(some.evaluations, one.evaluations);
  EXPECT_EQ(some.tight_pairs, one.tight_pairs);
}

INSTANTIATE_TEST_SUITE_P(Threads, LargeScene, testing::Values(2U, 3U, 8U));

/// Pairs that are advanced together are no less safe than one after the other: along the step found no gap
/// falls below the part that is to be kept, and a little further one does.
TEST_F(LargeScene, StepKeepsItsPartOfEveryGap)
{
  constexpr double keep = 0.1;
  const SafeStep step = largest_safe_step(model, state, dy, keep, 2);
  const double first = smallest_gap(model, state, 1.0);
  double least = first;
  for (int k = 1; k <= 20; ++k)
    least = std::min(least, smallest_gap(model, advanced(model, state, dy, step.alpha * k / 20.0), 1.0));
  EXPECT_GE(least, 0.5 * keep * first);  // certified gaps are at least half of the gap
  EXPECT_LT(smallest_gap(model, advanced(model, state, dy, 1.0), 1.0), 0.0);
}

}  // namespace
}  // namespace hauberk::test
