// The limit as a constrained problem, without any barrier: a method of another kind, on exact limits and on
// one that only the barriers gave so far.

#include "limit_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

LimitSettings constrained()
{
  LimitSettings settings;
  settings.contact = ContactChoice::constrained;
  return settings;
}

/// Relative error of 1 + value, printed.
double error(const char* what, const LimitResult& r, double exact)
{
  const double e = (1.0 + *r.value) / (1.0 + exact) - 1.0;
  fmt::print(
      "{}: value {:.12f}, error {:.1e}, estimate {:.1e}, {} steps, {} evaluations, forces miss the load by "
      "{:.1e}\n",
      what, *r.value, e, r.error_estimate.value_or(-1.0), r.iterations, r.evaluations, *r.force_balance);
  return e;
}

TEST(Constrained, ExactLimitsAndTheMarginThatIsLeft)
{
  const SceneSpec round = slack_chain({5, 0.7, 0.7}, {4, 0.5, 0.5}),
                  oval = slack_chain({6, 1.0, 1.8}, {5, 0.6, 1.2});
  const double of_round = 2.0 * (5.0 + 4.0 - 0.7 - 0.5) / round.lattice[0].x() - 1.0;
  const double of_oval = 2.0 * (6.0 + 5.0 - 1.0 - 0.6) / oval.lattice[0].x() - 1.0;
  const double of_threefold = (2.0 * 4.25 + 2.0 * 2.575 - 2.0 * 0.95) / test::threefold_spacing - 1.0;
  const struct {
    const char* name;
    SceneSpec scene;
    double direction, exact;
  } cases[] = {{"chain", round, 0.0, of_round},
               {"oval chain", oval, 0.0, of_oval},
               {"threefold", test::threefold_round(), 90.0, of_threefold}};
  for (const auto& c : cases) {
    const LimitResult r = limit(c.scene, c.direction, Sense::positive, constrained());
    ASSERT_EQ(r.status, LimitStatus::locked) << c.name << ": " << r.message;
    EXPECT_EQ(r.contact, "constrained");
    const double e = error(c.name, r, c.exact);
    EXPECT_NEAR(e, 0.0, 1e-8);
    // What the margin takes is known to first order.
    EXPECT_NEAR(-e * (1.0 + c.exact), *r.error_estimate, 1e-3 * *r.error_estimate + 1e-12) << c.name;
    EXPECT_LT(*r.force_balance, 1e-5);
  }
}

TEST(Constrained, AgreesWithTheBarriersAndTheirForcesAndSensitivities)
{
  const SceneSpec mail = test::chainmail(1, 1);
  const LimitResult barrier = limit(mail, 0.0, Sense::positive);
  const LimitResult r = limit(mail, 0.0, Sense::positive, constrained());
  ASSERT_EQ(barrier.status, LimitStatus::locked) << barrier.message;
  ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
  error("chainmail", r, *barrier.value);
  EXPECT_NEAR(*r.value, *barrier.value, 1e-8);
  // Less what their gaps and its margin take they are the same.
  EXPECT_NEAR(*r.value + *r.error_estimate, *barrier.value + *barrier.error_estimate, 2e-11);
  EXPECT_NEAR(*r.sensitivity_clearance, *barrier.sensitivity_clearance,
              1e-4 * std::abs(*barrier.sensitivity_clearance));
}

/// Compressed along a lattice direction the symmetric state of the threefold element is a saddle (-0.06095),
/// at which forces balance: an unperturbed start runs into it.
TEST(Constrained, LeavesASaddle)
{
  LimitSettings settings = constrained();
  settings.perturbation = 0.0;
  const LimitResult r = limit(test::threefold_round(), 90.0, Sense::negative, settings);
  ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
  EXPECT_EQ(r.message, "");
  EXPECT_LT(*r.value, -0.0629);
  settings.perturbation = 1e-3;
  const LimitResult perturbed = limit(test::threefold_round(), 90.0, Sense::negative, settings);
  ASSERT_EQ(perturbed.status, LimitStatus::locked) << perturbed.message;
  EXPECT_NEAR(*r.value, *perturbed.value, 1e-8);
}

/// Steps are no longer than half a tube is thick, so that none passes through another: too short for
/// hair-thin ones.
TEST(Constrained, SaysWhereItDoesNotConverge)
{
  const LimitResult r =
      limit(test::chain({5, 0.02, 0.02}, {5, 0.02, 0.02}, 12.0), 0.0, Sense::positive, constrained());
  EXPECT_EQ(r.status, LimitStatus::stalled);
  EXPECT_EQ(r.contact, "constrained");
  EXPECT_NE(r.message.find("no balance of forces after 300 quadratic programs: forces miss the load by"),
            std::string::npos)
      << r.message;
}

}  // namespace
}  // namespace hauberk::brute
