/// The ladder of activation distances.

#include "equilibrium/locking.hpp"
#include "limits/limits.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::test {
namespace {

TEST(Stages, FallFromTheFirstToTheLastByEqualFactors)
{
  for (const double last : {0.03, 0.02, 3e-3, 2.9e-3, 1e-3, 5e-5, 2e-9}) {
    Schedule s;
    s.last = last;
    const std::vector<double> g = activation_distances(s);
    EXPECT_EQ(g.back(), last);
    EXPECT_EQ(g.front(), s.first);
    for (std::size_t k = 1; k < g.size(); ++k) {
      EXPECT_GE(g[k] / g[k - 1], s.ratio * (1.0 - 1e-6));
      EXPECT_NEAR(g[k] / g[k - 1], g[1] / g[0], 1e-12);
    }
    // No more of them than that needs.
    const double all = s.last / s.first, steps = static_cast<double>(g.size()) - 1.0;
    if (steps > 1.0) {
      EXPECT_LT(std::pow(all, 1.0 / (steps - 1.0)), s.ratio);
    }
  }
}

TEST(Stages, OneStageWhereFirstIsLast)
{
  Schedule s;
  s.first = s.last = 2e-5;
  EXPECT_EQ(activation_distances(s), std::vector<double>{2e-5});
}

/// A taut chain of perpendicular rings: seen from a ring, the next one's core is 2 r away and curved by 1/(2
/// r), its own by 1/R. A stage ends as merging just where the limit on curvatures is above that.
TEST(Stages, EndWhereContactsAreLessCurvedThanTheyMay)
{
  const double R = 5.0, r = 0.7;
  const Sheet load;
  const Model m = make_model(chain({R, r, r}, {R, r, r}, 4.0 * R - 4.0 * r - 1e-3), load, 0.0);
  const double curvature = (1.0 / (2.0 * r) - 1.0 / R) * m.length;
  for (const double part : {0.999, 1.001}) {
    Stage stage;
    stage.contact = {Formulation::nearest, 1e-4, 0.0};
    stage.mu = 1e-6;
    stage.least_curvature = part * curvature;
    State s = rest_state(m);
    const StageResult r_ =
        solve_stage(m, s, load_vector(m, Direction(), Sense::positive), stage, [] { return true; });
    EXPECT_EQ(r_.status, part < 1.0 ? StageStatus::minimum : StageStatus::merging) << r_.message;
  }
}

/// Gaps of the last stages are below the rounding of coordinates here. The end is as narrow as can be, and
/// says by how much its value is short: closed, it is that of a taut chain, 4 R - 4 r by the cell's length.
TEST(Stages, EndWiderWhereNoStepOfANarrowOneCanBeCertified)
{
  const double R = 5.0, r = 0.7, cell = 12.0;
  const Sheet load;
  const Model m = make_model(chain({R, r, r}, {R, r, r}, cell), load, 0.0);
  Schedule schedule;
  schedule.last = 1e-14;
  const MacroLoad pull{load_vector(m, Direction(), Sense::positive), Matrix(m.macro_count, 0)};
  const Locked l = lock(m, rest_state(m), pull, ContactChoice::automatic, schedule, [] { return true; });
  ASSERT_EQ(l.status, LockStatus::locked) << l.message;
  EXPECT_EQ(l.message.find("gaps are left "), 0U) << l.message;
  EXPECT_GT(l.stages.back().g_hat, schedule.last);
  const double short_by = (4.0 * R - 4.0 * r) / cell - 1.0 - pull.pull.dot(l.state.macro);
  EXPECT_GT(short_by, 0.0);
  ASSERT_TRUE(l.error_estimate);
  EXPECT_NEAR(*l.error_estimate, short_by, 0.01 * short_by);
}

/// Stages that only lead on go along ribbons of flat tubes, the last one goes over their surfaces: how its
/// value falls short is not a remainder of theirs.
TEST(Stages, SayHowFarAWideEndOfFlatTubesFallsShort)
{
  const double R = 5.0, r0 = 0.7, r1 = 1.2, cell = 12.0;
  const Sheet load;
  const Model m = make_model(chain({R, r0, r1}, {R, r0, r1}, cell), load, 0.0);
  const MacroLoad pull{load_vector(m, Direction(), Sense::positive), Matrix(m.macro_count, 0)};
  const auto ends = [&](double last) {
    Schedule schedule;
    schedule.last = last;
    return lock(m, rest_state(m), pull, ContactChoice::automatic, schedule, [] { return true; });
  };
  const Locked narrow = ends(2e-9);
  ASSERT_EQ(narrow.status, LockStatus::locked) << narrow.message;
  const double limit = pull.pull.dot(narrow.state.macro);
  for (const double last : {1e-2, 1e-3}) {
    const Locked wide = ends(last);
    ASSERT_EQ(wide.status, LockStatus::locked) << wide.message;
    EXPECT_EQ(wide.stage.contact.formulation, Formulation::arc);
    EXPECT_EQ(wide.stage.contact.sides, Sides::both);
    const double short_by = limit - pull.pull.dot(wide.state.macro);
    EXPECT_GT(short_by, 0.01 * last);
    ASSERT_TRUE(wide.error_estimate);
    EXPECT_NEAR(*wide.error_estimate, short_by, 0.15 * short_by) << last;
  }
}

/// Rough integrals change with their panels from step to step by more than steps can gain at last. A stage
/// that may end there comes to the same value in fewer steps, with forces that balance to some per cent.
TEST(Stages, MayEndAtTheNoiseOfARoughIntegral)
{
  const Sheet load(2);
  SceneSpec scene = chainmail(1, 1);
  scene.elements[0].parameters = {4.85, 1.12, 1.04};
  scene.elements[1].parameters = {4.80, 1.02, 1.14};
  const Model m = make_model(scene, load, 0.0);
  int fewer = 0;
  for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0}) {
    const Vector pull = load_vector(m, Direction::at_degrees(degrees), Sense::positive);
    Schedule schedule;
    schedule.last = 3e-3;
    const auto lock_with = [&](bool at_noise) {
      schedule.ends_at_noise = at_noise;
      return lock(m, perturbed(m, rest_state(m), 1e-2, 1, Copies::apart), pull, ContactChoice::automatic,
                  schedule, [] { return true; });
    };
    const Locked exact = lock_with(false), early = lock_with(true);
    ASSERT_EQ(exact.status, LockStatus::locked) << exact.message;
    ASSERT_EQ(early.status, LockStatus::locked) << early.message;
    EXPECT_NEAR(pull.dot(early.state.macro), pull.dot(exact.state.macro), 1e-4) << degrees;
    EXPECT_LT(early.stages.back().residual, 0.05) << degrees;
    fewer += exact.iterations - early.iterations;
  }
  EXPECT_GT(fewer, 60);
}

/// One pair of flat rings takes thousands of evaluations: who wants to stop does not wait for its end, and
/// gets the last state that was whole.
TEST(Stages, AreInterruptedWithinOnePair)
{
  const Sheet load;
  const Model m = make_model(chain({5.0, 0.7, 0.05}, {5.0, 0.7, 0.05}, 12.0), load, 0.0);
  for (const Formulation formulation : {Formulation::arc, Formulation::nearest}) {
    Stage stage;
    stage.contact = {formulation, 1.0, 0.0};
    stage.mu = 0.1;
    State s = rest_state(m);
    int asked = 0;
    const StageResult r = solve_stage(m, s, load_vector(m, Direction(), Sense::positive), stage,
                                      [&asked] { return ++asked < 4; });
    EXPECT_EQ(r.status, StageStatus::interrupted);
    EXPECT_EQ(r.iterations, 0) << "asked between steps alone";
    EXPECT_EQ(asked, 4);
    EXPECT_EQ(s.macro, rest_state(m).macro);
    EXPECT_EQ(s.e, rest_state(m).e);
  }
}

}  // namespace
}  // namespace hauberk::test
