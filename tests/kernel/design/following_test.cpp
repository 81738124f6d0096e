/// States of a design that are followed to another: locked ones, and the one at rest.

#include "equilibrium/barrier_path.hpp"
#include "model/held_model.hpp"
#include "model/links.hpp"
#include "uneven_chainmail.hpp"

#include <Eigen/QR>

#include <cmath>
#include <numbers>

namespace hauberk::test {
namespace {

TEST(DesignProblem, LockedStatesAreFollowedToNearbyDesigns)
{
  const AtStart start;
  const DesignSpec& design = start.design;
  const DesignPoint at = start.problem.current();
  const WarmStart& tight = at.warm[0].back();
  EXPECT_NEAR(tight.g_hat, 1e-2, 1e-12);
  const double before = smallest_gap(at.model, tight.state, 0.03);
  const auto neighbour = [&](double h) {
    DesignPoint to = at;
    to.x[0] -= h;
    to.x[3] += h;
    to.spec = with_variables(start.scene, design.variables, to.x);
    to.model = make_model(to.spec, start.load, 0.0);
    return to;
  };
  // Gaps are kept to the second order, strain and poses moving along.
  std::array<double, 2> change{};
  for (std::size_t k = 0; k < 2; ++k) {
    const DesignPoint to = neighbour(0.02 / static_cast<double>(1U << k));
    const auto state = followed(at, tight, to, design.variables);
    ASSERT_TRUE(state.has_value());
    change[k] = std::abs(smallest_gap(to.model, *state, 0.03) - before);
  }
  EXPECT_LT(change[0], 0.3 * before);
  EXPECT_LT(change[1], 0.35 * change[0]) << change[0] << " " << change[1];
  // Where the linear motion would close gaps, in parts: gaps stay open, and no link is lost.
  const DesignPoint far = neighbour(0.1);
  const auto state = followed(at, tight, far, design.variables);
  ASSERT_TRUE(state.has_value());
  EXPECT_GE(smallest_gap(far.model, *state, 0.03), 0.01 * tight.g_hat);
  EXPECT_TRUE(links_kept(far.model, *state));
  // A ring of which the other one fills the hole has no state to follow.
  EXPECT_FALSE(followed(at, tight, neighbour(1.4), design.variables).has_value());
}

/// Tight stages are followed where the change of shapes fits their gaps, wider ones where it does not: a
/// trial costs no more than what it saves, whichever way it goes.
TEST(DesignProblem, FollowingIsCheaperThanRest)
{
  DesignSpec design = spec();
  design.schedule = Schedule();
  design.schedule.last = 1e-4;
  AtStart start(design);
  const long from_rest = start.problem.evaluations();
  for (const double h : {1e-4, 1e-3, 1e-2, 0.03, 0.1}) {
    std::vector<double> x = start.x;
    x[0] += h;
    x[2] -= h;
    x[3] += 0.5 * h;
    const long before = start.problem.evaluations();
    ASSERT_TRUE(start.problem.evaluate(x, true).ok) << h;
    // Rest is searched from twice: half of it is what a trial costs of which no state can be followed.
    EXPECT_LT(start.problem.evaluations() - before, h < 5e-3 ? from_rest / 8 : 2 * from_rest / 5) << h;
  }
}

TEST(DesignProblem, WhatIsHeldIsKeptWhereGapsAreOpened)
{
  const AtStart start;
  const DesignPoint at = start.problem.current();
  const WarmStart& tight = at.warm[0].back();
  // Conditions that the state keeps: all strains but along its own.
  const Vector& macro = tight.state.macro;
  const Matrix held =
      Eigen::HouseholderQR<Matrix>(Matrix(macro)).householderQ() * Matrix::Identity(3, 3).rightCols(2);
  ASSERT_LT(missed(held, macro), 1e-15);
  DesignPoint to = at;
  to.x[0] -= 0.1;
  to.x[3] += 0.1;
  to.spec = with_variables(start.scene, start.design.variables, to.x);
  to.model = make_model(to.spec, start.load, 0.0);
  const auto state = followed(at, tight, to, start.design.variables, held);
  ASSERT_TRUE(state.has_value());
  EXPECT_GT((state->macro - macro).norm(), 1e-3);
  EXPECT_LT(missed(held, state->macro), 1e-15);

  // Along the motion of a minimum, too: where a load along the state's own strain holds the others.
  const MacroLoad load(macro, held);
  const HeldModel kept(at.model, held);
  const Schedule& schedule = start.design.schedule;
  const PlannedStage plan = planned_stage(at.model, ContactChoice::automatic, schedule, tight.g_hat, true);
  const MinimumOf minimum{barrier_stage(at.model, load_size(kept.model(), kept.pull(macro)),
                                        ContactChoice::automatic, schedule, plan),
                          load};
  long evaluations = 0;
  const auto moved = followed(at, tight, to, start.design.variables, held, &minimum, &evaluations);
  ASSERT_TRUE(moved.has_value());
  EXPECT_GT(evaluations, 0);
  EXPECT_LT(missed(held, moved->macro), 1e-14);
  EXPECT_GT((moved->macro - state->macro).norm(), 1e-9) << "the same prediction";
}

TEST(DesignProblem, RestIsFollowedAroundWhatTheStraightWayCollidesWith)
{
  AtStart start;
  DesignProblem& problem = start.problem;
  const DesignSpec& design = start.design;
  const std::vector<double> d = {0.0, 0.08, 0.0, 0.06};
  std::vector<double> y = start.x;
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += d[k];
  const Model thick = make_model(with_variables(start.scene, design.variables, y), start.load, 0.0);
  const Vector dx = Eigen::Map<const Vector>(d.data(), 4);
  const Vector straight = rest_response(problem.current(), design.variables) * dx;
  ASSERT_LT(safe_parameter_step(problem.current().model, thick, problem.current().rest, straight), 1.0);
  EXPECT_EQ(problem.largest_safe_step(start.x, d), 1.0);
  ASSERT_TRUE(problem.evaluate(y, true).ok);
  problem.accept(y);
  EXPECT_TRUE(links_kept(problem.current().model, problem.current().rest));
  EXPECT_GT(problem.rest_distance(), 0.0);  // what is missing is left to the constraints
}

/// Rings of radius R about (6.4, 0, 0) and its copies by 120 degrees, which touch their neighbours and have a
/// void in the middle; through it go two thin rings that stand upright, so that the fabric is a chain.
SceneSpec chain_through_voids()
{
  std::vector<Rings::Ring> three(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * static_cast<double>(k);
    three[k].position = 6.4 * Vec3(std::cos(angle), std::sin(angle), 0.0);
  }
  SceneSpec s;
  s.types = {{"three", std::make_shared<Rings>(three)}, {"one", std::make_shared<Rings>()}};
  s.lattice = {{26, 0, 0}, {0, 100, 0}};
  s.elements.resize(2);
  s.elements[0].parameters = {5.3, 0.6, 0.6, 5.3, 0.6, 0.6, 5.3, 0.6, 0.6};
  s.elements[1].type = 1;
  s.elements[1].parameters = {12.85, 0.1, 0.1};
  s.elements[1].rest = {{13, 0, 0}, rotation_exp({0.5 * std::numbers::pi, 0, 0})};
  s.length = 5.3;
  return s;
}

/// The void is a loop of three primitives until one of them is so small that it touches the others no longer;
/// the thin rings, 0.2 across, do not fit through the gap of 0.085, so there still is a limit.
TEST(DesignProblem, LinksAreCountedAnewWhereLoopsOpen)
{
  const Sheet load(2);
  DesignSpec d = spec();
  d.variables = {{"0/R", {{0, 0}}, 4.4, 5.5}};
  d.targets = {{0.0, 0.1, 1.0}};
  d.hole_clearance = d.rest_clearance = 0.01;
  DesignProblem problem({chain_through_voids(), load, 0.0, LimitSettings{}, d, 1, [] { return true; }});
  const std::vector<double> closed{5.3}, open{4.5};
  ASSERT_TRUE(problem.evaluate(closed, false).ok);
  problem.accept(closed);
  EXPECT_EQ(problem.current().model.links.size(), 2U);
  EXPECT_EQ(problem.current().model.first_loop.back(), 1);
  ASSERT_TRUE(problem.evaluate(open, false).ok);
  problem.accept(open);
  EXPECT_TRUE(problem.current().model.first_loop.empty());
  EXPECT_TRUE(problem.current().model.links.empty());
  EXPECT_TRUE(links_kept(problem.current().model, problem.current().rest));
}

TEST(DesignProblem, FollowedStatesAreCheckedEveryFewSteps)
{
  // Here rest leads to the states that are followed, so a check finds the same values another way.
  DesignSpec values = spec();
  values.quantity = DesignQuantity::positive;
  AtStart start(values);
  DesignProblem& problem = start.problem;
  std::vector<double> x = start.x;
  int checks = 0;
  for (int k = 0; k < 8; ++k) {
    x[0] += 0.02;
    ASSERT_TRUE(problem.evaluate(x, true).ok);
    const long before = problem.evaluations();
    const std::vector<double> followed_values = [&] {
      std::vector<double> r(2), J(8);
      EXPECT_TRUE(problem.residuals(x, r, J));
      return r;
    }();
    problem.accept(x);
    EXPECT_EQ(problem.current().unchecked, (k + 1) % 4);
    const bool checked = problem.evaluations() > before;
    EXPECT_EQ(checked, (k + 1) % 4 == 0);
    checks += checked ? 1 : 0;
    std::vector<double> r(2), J(8);
    ASSERT_TRUE(problem.residuals(x, r, J));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(r[i], followed_values[i], 1e-6) << i;
  }
  EXPECT_EQ(checks, 2);
}

TEST(DesignProblem, WhatMeetsTheTargetsIsCheckedAtOnce)
{
  DesignSpec values = spec();
  values.quantity = DesignQuantity::positive;
  const std::vector<double> goal = [&values] {
    AtStart start(values);
    std::vector<double> x = start.x;
    x[0] += 0.02;
    EXPECT_TRUE(start.problem.evaluate(x, false).ok);
    start.problem.accept(x);
    EXPECT_EQ(start.problem.current().unchecked, 1);
    return start.problem.current().values;
  }();
  for (std::size_t i = 0; i < goal.size(); ++i) values.targets[i].value = goal[i];
  values.tolerance = 1e-3;
  AtStart start(values);
  ASSERT_FALSE(meets_targets(values, start.problem.current().values));
  std::vector<double> x = start.x;
  x[0] += 0.02;
  ASSERT_TRUE(start.problem.evaluate(x, false).ok);
  const long before = start.problem.evaluations();
  start.problem.accept(x);
  EXPECT_EQ(start.problem.current().unchecked, 0);
  EXPECT_GT(start.problem.evaluations(), before);
  EXPECT_TRUE(meets_targets(values, start.problem.current().values));
}

TEST(DesignProblem, ASearchEndsWithWhatRestLeadsTo)
{
  DesignSpec values = spec();
  values.quantity = DesignQuantity::positive;
  values.rest_clearance = 1e-3;  // that the start satisfies the constraints
  const auto moved = [](DesignProblem& problem, std::vector<double> x, double h) {
    x[0] += h;
    EXPECT_TRUE(problem.evaluate(x, false).ok);
    problem.accept(x);
    EXPECT_EQ(problem.current().unchecked, 1);
    return problem.current().objective;
  };
  for (const double h : {0.02, -0.02}) {
    AtStart start(values);
    const double first = start.problem.current().objective;
    const bool worse = moved(start.problem, start.x, h) > first;
    const long before = start.problem.evaluations();
    EXPECT_EQ(start.problem.settle(), worse) << h;
    EXPECT_GT(start.problem.evaluations(), before);  // it was checked
    EXPECT_EQ(start.problem.current().unchecked, 0);
    EXPECT_EQ(start.problem.current().x == start.x, worse);
    if (worse) {
      EXPECT_EQ(start.problem.current().objective, first);
    }
    // From there it goes on, and what is known to be led to by rest is not looked for again.
    const long settled = start.problem.evaluations();
    EXPECT_FALSE(start.problem.settle());
    EXPECT_EQ(start.problem.evaluations(), settled);
  }
}

}  // namespace
}  // namespace hauberk::test
