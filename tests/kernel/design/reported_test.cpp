/// States of limits as they are reported, in the unknowns of the design that a search follows.

#include "equilibrium/gaps.hpp"
#include "equilibrium/relaxation.hpp"
#include "uneven_chainmail.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

/// A design whose elements overlap where the scene has them, and not at its relaxed rest; and its report, at
/// another scale.
struct Relaxing {
  Sheet load{2};
  DesignPoint point;
  ReportedStates reported;

  Relaxing()
  {
    point.spec = uneven_chainmail();
    for (PlacedElement& element : point.spec.elements) element.parameters[1] = element.parameters[2] = 1.0;
    // Off the middle by more than there is room for.
    point.spec.elements[1].rest.position += Vec3(0.5, 0.6, 0.0);
    point.model = make_model(point.spec, load, 0.0);
    const State reference = rest_state(point.model);
    EXPECT_LT(smallest_gap(point.model, reference, 0.1), -1e-3);
    const Relaxed relaxed = relax(point.model, reference, 0.005, Cell::fixed);
    EXPECT_EQ(relaxed.problem, "");
    point.rest = relaxed.state;
    reported.scene = with_relaxed_rest(point);
    reported.scene.length = 5.3;
    reported.model = make_model(reported.scene, load, 0.0);
  }

  /// A state near the reported rest, strain included.
  State moved(unsigned seed) const
  {
    std::mt19937_64 rng(seed);
    std::uniform_real_distribution<double> uniform(-0.02, 0.02);
    Vector dy(reported.model.dofs());
    for (double& x : dy) x = uniform(rng);
    return advanced(reported.model, rest_state(reported.model), dy, 1.0);
  }
};

TEST(ReportedStates, HaveTheirPosesInTheUnknownsOfTheDesign)
{
  Relaxing r;
  for (unsigned seed = 0; seed < 4; ++seed) r.reported.states.emplace_back(r.moved(seed));
  r.reported.states.emplace_back(std::nullopt);
  const std::vector<std::optional<State>> carried = carried_to(r.point, r.reported);
  ASSERT_EQ(carried.size(), 5U);
  EXPECT_FALSE(carried[4]);
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_TRUE(carried[k]) << k;
    EXPECT_EQ(carried[k]->macro, r.reported.states[k]->macro);  // strains have no scale
    const std::vector<Pose> here = poses(r.point.model, *carried[k]);
    const std::vector<Pose> there = poses(r.reported.model, *r.reported.states[k]);
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_LE(
          (here[i].position * r.point.model.length - there[i].position * r.reported.model.length).norm(),
          1e-12);
      EXPECT_LE((here[i].rotation - there[i].rotation).norm(), 1e-13);
    }
  }
}

TEST(ReportedStates, AreNoneWhereTheirRestIsOutOfReach)
{
  Relaxing r;
  r.reported.scene.elements[1].rest.position.z() += 30.0;  // out of the rings that it is linked with
  r.reported.model = make_model(r.reported.scene, r.load, 0.0);
  r.reported.states.emplace_back(rest_state(r.reported.model));
  EXPECT_FALSE(carried_to(r.point, r.reported).front());
}

}  // namespace
}  // namespace hauberk::test
