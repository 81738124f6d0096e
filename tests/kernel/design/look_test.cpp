/// How often the states of a design are looked for from rest that meets its targets.

#include "equilibrium/rest.hpp"
#include "limits/limits.hpp"
#include "uneven_chainmail.hpp"

#include <vector>

namespace hauberk::test {
namespace {

constexpr int start_that_folds_further = 3;

/// Two thin rings, pushed together at 45 degrees: from small perturbations of rest they lock at 0.543, from a
/// large one at 0.670. The target is the former; a report finds the latter by the look that is told to.
struct Folding {
  Sheet load{2};
  std::vector<Look> asked;
  Look finds = Look::usual;
  bool exceeds = false;  ///< what is reported until a target is exceeded ends at once

  static DesignSpec design()
  {
    DesignSpec d = spec();
    d.quantity = DesignQuantity::negative;
    d.targets = {{45.0, -0.543, 1.0}};
    d.tolerance = 0.05;
    d.schedule.last = 1e-3;
    return d;
  }

  static SceneSpec scene()
  {
    SceneSpec s = uneven_chainmail();
    for (PlacedElement& ring : s.elements) ring.parameters[1] = ring.parameters[2] = 0.7;
    return s;
  }

  ReportedStates report(const SceneSpec& relaxed, Look look)
  {
    asked.push_back(look);
    ReportedStates out{relaxed, make_model(relaxed, load, 0.0), {std::nullopt}, 1, false};
    out.in_part = exceeds && look == Look::until_exceeded;
    if (look != finds) return out;
    LimitSettings settings;
    settings.schedule = design().schedule;
    const LimitTask task = target_limits(design()).tasks[0];
    out.states[0] =
        limit_from_start(out.model, task, settings, start_that_folds_further, [] { return true; }).state;
    return out;
  }

  /// The value with which the design as it is given is accepted.
  double accepted_value(Look at_the_goal)
  {
    DesignProblem problem({scene(), load, 0.0, LimitSettings{}, design(), 1, [] { return true; },
                           [this](const SceneSpec& relaxed, Look look) { return report(relaxed, look); }});
    problem.set_schedule(design().schedule, at_the_goal);
    const std::vector<double> x = problem.scene_variables();
    EXPECT_TRUE(problem.evaluate(x, true).ok);
    EXPECT_TRUE(meets_targets(design(), problem.current().values));
    problem.accept(x);
    return problem.current().values[0];
  }
};

TEST(Look, IsQuickInACoarseSearch)
{
  Folding f;
  EXPECT_NEAR(f.accepted_value(Look::quick), -0.543, 1e-2);
  EXPECT_EQ(f.asked, std::vector<Look>{Look::quick});
}

TEST(Look, IsWholeWhereAQuickOneLeadsNowhereElse)
{
  Folding f;
  f.finds = Look::until_exceeded;
  EXPECT_NEAR(f.accepted_value(Look::quick_then_whole), -0.670, 1e-2);
  EXPECT_EQ(f.asked, (std::vector<Look>{Look::quick, Look::until_exceeded}));
}

TEST(Look, GoesOnWhereItEndedThoughTheDesignMeetsItsTargets)
{
  Folding f;
  f.exceeds = true;
  f.finds = Look::whole;
  EXPECT_NEAR(f.accepted_value(Look::quick_then_whole), -0.670, 1e-2);
  EXPECT_EQ(f.asked, (std::vector<Look>{Look::quick, Look::until_exceeded, Look::whole}));
}

/// A limit that is too far for its target already; others, and those that are not locked, may still be met.
TEST(Look, HasSeenEnoughWhereATargetIsExceeded)
{
  DesignSpec d = Folding::design();
  d.targets = {{0.0, -0.2, 1.0}, {45.0, -0.5, 1.0}};
  const auto pushed = [](double value) {
    LimitResult r;
    r.status = LimitStatus::locked;
    r.value = value;
    return r;
  };
  EXPECT_FALSE(exceeds_targets(d, {pushed(-0.1), pushed(-0.1)})) << "both may still come to it";
  EXPECT_FALSE(exceeds_targets(d, {pushed(-0.2099), pushed(-0.4)}));
  EXPECT_TRUE(exceeds_targets(d, {pushed(-0.1), pushed(-0.53)}));
  LimitResult open = pushed(-0.53);
  open.status = LimitStatus::stalled;
  EXPECT_FALSE(exceeds_targets(d, {pushed(-0.1), open}));
  d.targets[1].aim = Aim::no_nearer;
  EXPECT_FALSE(exceeds_targets(d, {pushed(-0.1), pushed(-0.9)}));
  d.targets[1].aim = Aim::no_further;
  EXPECT_TRUE(exceeds_targets(d, {pushed(-0.1), pushed(-0.502)}));
  d.targets[1].aim = Aim::reach;
  d.tolerance.reset();
  EXPECT_FALSE(exceeds_targets(d, {pushed(-0.9), pushed(-0.9)})) << "without a tolerance nothing is exceeded";

  d.quantity = DesignQuantity::eta;
  d.tolerance = 0.05;
  d.targets = {{0.0, 0.2, 1.0}};
  EXPECT_FALSE(exceeds_targets(d, {pushed(0.1), pushed(-0.05)}));
  EXPECT_TRUE(exceeds_targets(d, {pushed(0.1), pushed(-0.1)}));
}

TEST(Look, EndsWhereAQuickOneLeadsElsewhere)
{
  Folding f;
  f.finds = Look::quick;
  EXPECT_NEAR(f.accepted_value(Look::quick_then_whole), -0.670, 1e-2);
  EXPECT_EQ(f.asked, std::vector<Look>{Look::quick});
}

}  // namespace
}  // namespace hauberk::test
