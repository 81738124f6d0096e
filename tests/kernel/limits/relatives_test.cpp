/// Scenes that contain each other: which do, what a state of the one is in the other, and what limits learn
/// from it.

#include "limits/relatives.hpp"

#include "equilibrium/gaps.hpp"
#include "limits/limits.hpp"
#include "loadcases/in_plane_periodic/in_plane_periodic.hpp"
#include "loadcases/paraboloid_bending/paraboloid_bending.hpp"
#include "model/held_model.hpp"
#include "symmetric_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace hauberk::test {
namespace {

using Hold = InPlanePeriodic::Hold;
using Out = InPlanePeriodic::OutOfPlane;

constexpr Hold nothing{false, false}, shear{true, false}, both{true, true};

InPlanePeriodic sheet(Hold hold, Out out = {}) { return {StrainMeasure::tensor, out, hold}; }

/// A 4-in-1 sheet of thin wire: with so much room a compression ends in many folds.
SceneSpec loose(int m, int n)
{
  SceneSpec s = chainmail(1, 1, 36.5, 0.7);
  for (PlacedElement& e : s.elements) e.parameters[1] = 0.7;
  s = repeated(s, m, n);
  for (int k = 2; k < 2 * m * n; ++k) s.elements[k].copy_of = k % 2;
  return s;
}

/// Few searches, so that a limit alone is easily short.
LimitSettings few()
{
  LimitSettings s;
  s.fold_starts = 1;
  return s;
}

/// Each by itself.
LimitSettings many_starts()
{
  LimitSettings s = few();
  s.lessons = false;
  s.starts = 32;
  return s;
}

LimitResult compressed(const SceneSpec& scene, const LoadCase& load, double angle,
                       const LimitSettings& settings)
{
  const Model m = make_model(scene, load, 0.0);
  const std::vector<LimitTask> tasks{{Direction::at_degrees(angle), Sense::negative}};
  return compute_limits(m, scene, tasks, settings, 2)[0];
}

TEST(Relatives, LoadCasesContainWhatLeavesLessFreedom)
{
  const Out free{true, 0.0}, layer{false, 0.2}, thin{false, 0.1};
  const InPlanePeriodic flat = sheet(shear);
  EXPECT_TRUE(flat.contains(sheet(shear)));
  EXPECT_TRUE(sheet(nothing).contains(flat));
  EXPECT_TRUE(sheet(nothing).contains(sheet(both)));
  EXPECT_TRUE(flat.contains(sheet(both)));
  EXPECT_FALSE(flat.contains(sheet(nothing)));
  EXPECT_FALSE(flat.contains(sheet({false, true})));
  EXPECT_TRUE(sheet(shear, free).contains(flat));
  EXPECT_TRUE(sheet(shear, free).contains(sheet(shear, layer)));
  EXPECT_TRUE(sheet(shear, layer).contains(sheet(shear, thin)));
  EXPECT_FALSE(sheet(shear, thin).contains(sheet(shear, layer)));
  EXPECT_FALSE(sheet(shear, layer).contains(sheet(shear, free)));
  EXPECT_FALSE(flat.contains(InPlanePeriodic(StrainMeasure::equation_12, {}, shear))) << "another value";
  const ParaboloidBending bend({}), places({true, false, false}), twist({false, true, false});
  EXPECT_TRUE(bend.contains(places));
  EXPECT_TRUE(bend.contains(twist));
  EXPECT_FALSE(places.contains(bend));
  EXPECT_FALSE(twist.contains(places));
  EXPECT_FALSE(flat.contains(bend));
}

/// One step less freedom at a time, and each of them is contained.
TEST(Relatives, StricterLoadCasesAreContained)
{
  for (const bool free : {false, true}) {
    for (const Hold hold : {nothing, shear, Hold{false, true}, both}) {
      const InPlanePeriodic load = sheet(hold, {free, 0.0});
      const std::vector<StricterLoadCase> stricter = load.stricter();
      EXPECT_EQ(stricter.size(), std::size_t(free) + std::size_t(!hold.shear) + std::size_t(!hold.lateral));
      for (const StricterLoadCase& s : stricter) {
        EXPECT_TRUE(load.contains(*s.load)) << s.name;
        EXPECT_FALSE(s.load->contains(load)) << s.name;
      }
    }
  }
}

TEST(Relatives, ScenesContainCellsTheyAreMadeOfAndMoreClearance)
{
  const InPlanePeriodic load = sheet(shear);
  const auto has = [&](const SceneSpec& outer, double delta, const SceneSpec& inner, double inner_delta) {
    const Model a = make_model(outer, load, delta), b = make_model(inner, load, inner_delta);
    return contains(a, outer, b, inner);
  };
  EXPECT_TRUE(has(loose(2, 3), 0.0, loose(1, 1), 0.0));
  EXPECT_TRUE(has(loose(4, 2), 0.0, loose(2, 2), 0.1));
  EXPECT_TRUE(has(loose(2, 1), 0.1, loose(2, 1), 0.1));
  EXPECT_FALSE(has(loose(3, 3), 0.0, loose(2, 2), 0.0));
  EXPECT_FALSE(has(loose(1, 2), 0.0, loose(2, 1), 0.0));
  EXPECT_FALSE(has(loose(1, 1), 0.1, loose(1, 1), 0.0));
  SceneSpec thicker = loose(1, 1);
  thicker.elements[0].parameters[2] += 1e-6;
  EXPECT_FALSE(has(loose(2, 2), 0.0, thicker, 0.0));
  SceneSpec wider = loose(1, 1);
  wider.lattice[0] *= 1.0 + 1e-6;
  EXPECT_FALSE(has(loose(2, 2), 0.0, wider, 0.0));
}

/// Copies whose sizes differ, as a design's may, are searched as the elements that they are.
TEST(Relatives, CopiesOfOtherSizesAreNone)
{
  const InPlanePeriodic load = sheet(shear);
  SceneSpec scene = loose(2, 1);
  EXPECT_EQ(make_model(scene, load, 0.0).source, (std::vector<int>{0, 1, 0, 1}));
  scene.elements[2].parameters[0] *= 1.01;
  EXPECT_EQ(make_model(scene, load, 0.0).source, (std::vector<int>{0, 1, 2, 3}));
}

/// Images of a state's elements are the copies' elements: no gap changes.
TEST(Relatives, CarriedStatesHaveTheSameGaps)
{
  const SceneSpec small = loose(2, 1), large = loose(4, 3);
  const InPlanePeriodic flat = sheet(shear), free = sheet(shear, {true, 0.0});
  const Model from = make_model(small, flat, 0.0), to = make_model(large, free, 0.0);
  const Carrier carrier(from, small, to, large);
  ASSERT_TRUE(carrier.joined());
  State s = perturbed(from, rest_state(from), 0.05, 3, Copies::apart);
  s.macro << -0.02, 0.01, 0.005;
  const std::optional<State> there = carrier.state(s);
  ASSERT_TRUE(there);
  EXPECT_NEAR(smallest_gap(to, *there, 1.0), smallest_gap(from, s, 1.0), 1e-13);
  // Element 0 of cell (3, 2): of cell (1, 0) in the image (1, 2).
  const Pose pose = image_pose(to, *there, (2 * 4 + 3) * 2, {0, 0, 0});
  const Pose image = image_pose(from, s, 2, {1, 2, 0});
  EXPECT_LT((pose.position - image.position).norm(), 1e-13);
  EXPECT_LT((pose.rotation - image.rotation).norm(), 1e-14);
  // What has a height has no state in the plane.
  const Carrier back(to, large, from, small);
  State high = *there;
  high.e[2] += 1e-3;
  EXPECT_FALSE(back.state(high));
}

/// Rest states with a body between them are not joined.
TEST(Relatives, RestsApartAreNotJoined)
{
  const InPlanePeriodic load = sheet(shear);
  const SceneSpec here = chain({5, 0.7, 0.7}, {5, 0.7, 0.7}, 12.0);
  SceneSpec there = here;
  there.elements[1].rest.position.x() += 12.0 - 2.0 * 6.0 + 0.5;
  const Model a = make_model(here, load, 0.0), b = make_model(there, load, 0.0);
  EXPECT_TRUE(Carrier(a, here, b, there).joined());
  there.elements[1].rest.position.x() = -6.0;  // linked with the images on the other side
  const Model c = make_model(there, load, 0.0);
  EXPECT_FALSE(Carrier(a, here, c, there).joined());
}

/// A limit with less held is no nearer than one with more, and one with z free than one in the plane: alone
/// they are, here by 1 to 10 %.
TEST(Relatives, MoreFreedomGoesNoLessFar)
{
  struct Case {
    SceneSpec scene;
    InPlanePeriodic outer, inner;
    double angle;
  };
  const std::vector<Case> cases{{loose(1, 1), sheet(nothing), sheet(shear), 45.0},
                                {loose(1, 1), sheet(shear, {true, 0.0}), sheet(shear), 45.0}};
  for (const Case& c : cases) {
    LimitSettings alone = few();
    alone.lessons = false;
    const double inner = *compressed(c.scene, c.inner, c.angle, alone).value;
    ASSERT_GT(*compressed(c.scene, c.outer, c.angle, alone).value, inner + 1e-3)
        << "this scene tests nothing";
    const LimitResult r = compressed(c.scene, c.outer, c.angle, few());
    EXPECT_LE(*r.value, inner + 1e-7);
    EXPECT_EQ(r.status, LimitStatus::locked);
    EXPECT_EQ(r.message, "") << "locked itself, not copied: forces that do not balance are remarked on";
  }
}

/// A state with more held is a start like any other, and at times the one that leads furthest.
TEST(Relatives, StatesWithMoreHeldLeadOn)
{
  const InPlanePeriodic load = sheet(shear);
  LimitSettings alone = few();
  alone.lessons = false;
  const double short_of_it = *compressed(fourfold(), load, 20.0, alone).value;
  const LimitResult r = compressed(fourfold(), load, 20.0, few());
  EXPECT_LT(*r.value, short_of_it - 1e-3);
  const auto best = std::find_if(r.starts.begin(), r.starts.end(),
                                 [&](const LockedState& s) { return s.value == *r.value; });
  ASSERT_NE(best, r.starts.end());
  EXPECT_EQ(best->origin, "from lateral strain held");
}

/// A repeated cell finds what any of the cell's starts finds, not only what the first does.
TEST(Relatives, ACellIsInItsMultiples)
{
  const InPlanePeriodic load = sheet(shear);
  LimitSettings starts = many_starts();
  const double cell = *compressed(loose(1, 1), load, 45.0, starts).value;
  starts.starts = 1;
  ASSERT_GT(*compressed(loose(3, 1), load, 45.0, starts).value, cell + 1e-2) << "this scene tests nothing";
  LimitSettings learning = few();
  learning.fold_starts = 8;
  EXPECT_LE(*compressed(loose(3, 1), load, 45.0, learning).value, cell + 1e-7);
}

/// Cells that a repeated one consists of, a prime number of times along one axis: all others are in these.
TEST(Relatives, ACellIsInItsMultiplesStepByStep)
{
  const InPlanePeriodic load = sheet(both);
  const SceneSpec scene = loose(6, 2);
  const Model outer = make_model(scene, load, 0.0);
  std::vector<std::string> names;
  for (const Relative& r : relatives(outer, scene)) {
    names.push_back(r.name);
    const Model inner = make_model(r.scene, load, 0.0);
    EXPECT_TRUE(contains(outer, scene, inner, r.scene)) << r.name;
    EXPECT_TRUE(Carrier(inner, r.scene, outer, scene).joined()) << r.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"3 x 2 cells", "2 x 2 cells", "6 x 1 cells"}));
  const SceneSpec two = loose(2, 1);
  const std::vector<Relative> last = relatives(make_model(two, load, 0.0), two);
  ASSERT_EQ(last.size(), 1U);
  EXPECT_EQ(last[0].name, "one cell");
}

/// A fold of two cells that one cell has not is one of four.
TEST(Relatives, TwoCellsAreInFour)
{
  const InPlanePeriodic load = sheet(shear);
  LimitSettings starts = many_starts();
  const double one = *compressed(loose(1, 1), load, 20.0, starts).value;
  const double two = *compressed(loose(2, 1), load, 20.0, starts).value;
  ASSERT_LT(two, one - 1e-2) << "this scene tests nothing";
  LimitSettings learning = few();
  learning.fold_starts = 12;
  const LimitResult four = compressed(loose(4, 1), load, 20.0, learning);
  EXPECT_LE(*four.value, two + 1e-7);
  EXPECT_TRUE(std::ranges::any_of(four.starts, [&](const LockedState& s) {
    return s.origin == "from 2 x 1 cells" && s.value < one - 1e-2;
  }));
}

/// States that are given are begun from, whatever the sense; without lessons nothing is.
TEST(Relatives, GivenStatesAreBegunFrom)
{
  const InPlanePeriodic load = sheet(shear);
  const SceneSpec scene = loose(1, 1);
  const Model m = make_model(scene, load, 0.0);
  const LimitTask task{Direction::at_degrees(45.0), Sense::negative};
  LimitSettings starts = many_starts();
  std::vector<std::optional<State>> states;
  LimitsObserver observer;
  observer.on_states = [&states](const auto& found) { states = found; };
  const double far = *compute_limits(m, scene, {task}, starts, 2, observer)[0].value;
  ASSERT_EQ(states.size(), 1U);
  ASSERT_TRUE(states[0]);
  LimitSettings given = few();
  given.given.push_back({task.direction, task.sense, *states[0], "another scene"});
  const LimitResult r = compute_limits(m, scene, {task}, given, 2)[0];
  EXPECT_LE(*r.value, far + 1e-7);
  EXPECT_TRUE(std::any_of(r.starts.begin(), r.starts.end(),
                          [](const LockedState& s) { return s.origin == "from another scene"; }));
  given.lessons = false;
  EXPECT_GT(*compute_limits(m, scene, {task}, given, 2)[0].value, far + 1e-2);
}

/// Stopped while scenes that it contains are solved, a limit is no answer: one that went on from here as if
/// it were would end elsewhere than one that was never stopped.
TEST(Relatives, LimitsStoppedAmongTheirLessonsSaySo)
{
  const InPlanePeriodic load = sheet(shear);
  const SceneSpec scene = loose(1, 1);
  const Model m = make_model(scene, load, 0.0);
  std::atomic<bool> own_done = false;
  LimitsObserver observer;
  observer.on_start = [&own_done](std::size_t done, std::size_t total) { own_done = done == total; };
  observer.keep_going = [&own_done] { return !own_done; };
  const LimitTask task{Direction::at_degrees(45.0), Sense::negative};
  const LimitResult r = compute_limits(m, scene, {task}, few(), 1, observer)[0];
  EXPECT_EQ(r.status, LimitStatus::interrupted) << r.message;
}

/// Stopped at any moment and begun again from what was finished then, limits come out as if they were never
/// stopped, with all that was done for them.
TEST(Relatives, StoppedLimitsGoOnToTheSameEnd)
{
  const InPlanePeriodic load = sheet(shear);
  const SceneSpec scene = loose(1, 1);
  const Model m = make_model(scene, load, 0.0);
  std::vector<LimitTask> tasks;
  for (const double degrees : {0.0, 45.0}) tasks.push_back({Direction::at_degrees(degrees), Sense::negative});
  LimitSettings settings = few();
  settings.fold_starts = 2;  // and searches that go on where these do not agree
  long asked = 0;
  LimitsObserver count;
  count.keep_going = [&asked] { return ++asked > 0; };
  const std::vector<LimitResult> whole = compute_limits(m, scene, tasks, settings, 1, count);
  EXPECT_GT(whole[0].confidence.searches + whole[1].confidence.searches, 2 * 9) << "none goes on";
  int among_lessons = 0;
  for (const double part : {0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97}) {
    long left = static_cast<long>(part * static_cast<double>(asked));
    LimitsObserver stop;
    stop.keep_going = [&left] { return --left > 0; };
    std::vector<std::optional<LimitResult>> known;
    for (LimitResult& r : compute_limits(m, scene, tasks, settings, 1, stop)) {
      const bool finished = r.status != LimitStatus::interrupted && r.confidence.word != "unfinished";
      among_lessons += r.confidence.word == "unfinished" ? 1 : 0;
      EXPECT_FALSE(r.confidence.is_final()) << "it was stopped";
      r.resumed = true;
      known.push_back(finished ? std::optional(std::move(r)) : std::nullopt);
    }
    const std::vector<LimitResult> resumed = compute_limits(m, scene, tasks, settings, 1, {}, known);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const Confidence &a = whole[k].confidence, &b = resumed[k].confidence;
      EXPECT_EQ(whole[k].value, resumed[k].value) << part << ' ' << k;
      EXPECT_EQ(a.word, b.word) << part << ' ' << k;
      EXPECT_EQ(a.searches, b.searches) << part << ' ' << k;
      EXPECT_EQ(a.ended_here, b.ended_here) << part << ' ' << k;
      EXPECT_EQ(a.confirmed_by, b.confirmed_by) << part << ' ' << k;
    }
  }
  EXPECT_GT(among_lessons, 0) << "some were stopped while they learnt";
}

/// The limits that are solved for their states alone when one at 45 degrees is asked for.
std::vector<LimitResult> unreported(const SceneSpec& scene, const LoadCase& load, Sense sense)
{
  const Model m = make_model(scene, load, 0.0);
  std::vector<LimitResult> told;
  LimitsObserver observer;
  observer.on_unreported = [&told](const std::vector<LimitResult>& limits) { told = limits; };
  compute_limits(m, scene, {{Direction::at_degrees(45.0), sense}}, few(), 2, observer);
  return told;
}

/// Who counts work is told of limits that were solved for their states alone, also of those within them:
/// stretches inherit from scenes that learn themselves.
TEST(Relatives, ScenesThatWereSolvedAreTold)
{
  const std::vector<LimitResult> pushed = unreported(loose(2, 1), sheet(shear), Sense::negative);
  ASSERT_EQ(pushed.size(), 3U) << "one cell with the lateral strain held, the two cells with it, one cell";
  const std::vector<LimitResult> pulled = unreported(loose(2, 1), sheet(shear, {true, 0.0}), Sense::positive);
  ASSERT_EQ(pulled.size(), 3U) << "one cell with z fixed, which both others contain, once";
  for (const auto* limits : {&pushed, &pulled})
    for (const LimitResult& r : *limits) EXPECT_GT(r.evaluations, 0);
}

/// A state that is given is not lost to stages that are too wide for its fold.
TEST(Relatives, GivenStatesAreKept)
{
  const SceneSpec cell = loose(1, 1), sheet_of_four = loose(2, 2);
  const InPlanePeriodic flat = sheet(shear), layer = sheet(shear, {false, 0.5 / 4.9});
  const Model from = make_model(cell, flat, 0.1), to = make_model(sheet_of_four, layer, 0.1);
  const LimitTask task{Direction::at_degrees(45.0), Sense::negative};
  LimitSettings starts = few();
  starts.fold_starts = 32;
  std::vector<std::optional<State>> states;
  LimitsObserver observer;
  observer.on_states = [&states](const auto& found) { states = found; };
  compute_limits(from, cell, {task}, starts, 2, observer);
  ASSERT_TRUE(states.at(0));
  const Carrier carrier(from, cell, to, sheet_of_four);
  ASSERT_TRUE(carrier.joined());
  const std::optional<State> given = carrier.state(*states[0]);
  ASSERT_TRUE(given);
  const auto reached = [&](const State& s) {
    return -to.load->value(task.direction, {s.macro.data(), static_cast<std::size_t>(to.macro_count)});
  };
  const MacroLoad pull = macro_load(to, task.direction, task.sense);
  const Locked wide =
      lock(to, *given, pull, starts.contact, without_widest(starts.schedule), [] { return true; });
  ASSERT_LT(reached(wide.state), reached(*given) - 1e-6) << "this scene tests nothing";
  const Locked kept = limit_from_state(to, task, starts, *given, [] { return true; });
  EXPECT_EQ(kept.status, LockStatus::locked);
  EXPECT_GT(reached(kept.state), reached(*given) - 1e-7);
}

}  // namespace
}  // namespace hauberk::test
