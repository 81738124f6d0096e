/// The rest state: what is wrong with it, and relaxation that makes room.

#include "equilibrium/rest.hpp"

#include "equilibrium/gaps.hpp"
#include "equilibrium/relaxation.hpp"
#include "model/links.hpp"
#include "scenes.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

TEST(Rest, PublishedTiltViolatesTheClearanceAndSaysWhere)
{
  const Sheet load(2);
  const SceneSpec scene = chainmail(1, 1, 35.0);
  const Model m = make_model(scene, load, 0.098);
  const auto problems = rest_problems(scene, m, false);
  ASSERT_EQ(problems.size(), 4U);  // both rings, three rows away and in both directions

  EXPECT_EQ(
      problems[0],
      "element 0 (ring0 of ring) and element 1 (ring0 of ring) of image [-1, -2] are 0.0659695 apart at "
      "rest, less than "
      "solver.clearance 0.098; move them apart, lower the clearance, or set cell.relax to true");
}

TEST(Rest, NothingLinkedIsSaid)
{
  const Sheet load(2);
  SceneSpec scene = chain({5, 0.7, 0.7}, {5, 0.7, 0.7}, 40.0);
  const auto problems = rest_problems(scene, make_model(scene, load, 0.0), false);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0],
            "nothing is linked: no ring passes through another, so no direction has a limit; check "
            "positions, rotations and the cell's vectors");
}

TEST(Rest, RelaxationMakesRoomAndKeepsLinks)
{
  const Sheet load(2);
  const SceneSpec scene = chainmail(2, 2, 35.0);
  const Model m = make_model(scene, load, 0.0);
  const double target = 0.098 / m.length;
  ASSERT_LT(smallest_gap(m, rest_state(m), 0.1), target);
  const Relaxed r = relax(m, rest_state(m), target);
  EXPECT_EQ(r.problem, "");
  EXPECT_GE(smallest_gap(m, r.state, 0.1), target);
  EXPECT_LT(r.largest_motion, 0.05);
  EXPECT_TRUE(links_kept(m, r.state));
  EXPECT_EQ(r.state.macro.norm(), 0.0);
}

TEST(Rest, TouchingElementsAreOpened)
{
  const Sheet load(2);
  // Rings of one row would exactly touch without the turn: spacing 12.2 = 2 (R + r).
  SceneSpec scene = chainmail(1, 1);
  for (auto& e : scene.elements) {
    e.parameters = {4.9, 1.2, 1.2};
    e.rest.rotation = rotation_exp(Vec3(0, 0.02, 0)) * e.rest.rotation;  // a turn makes room in the row
  }
  const PreparedScene p = prepare_rest(scene, make_model(scene, load, 0.0));
  const Model m = make_model(p.scene, load, 0.0);
  EXPECT_GT(smallest_gap(m, rest_state(m), 0.1), 1e-8);
}

TEST(Rest, NoRoomIsSaid)
{
  const Sheet load(2);
  SceneSpec scene = chainmail(1, 1);
  for (auto& e : scene.elements) e.parameters = {6.5, 1.4, 1.4};
  try {
    prepare_rest(scene, make_model(scene, load, 0.0));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("; the tightest are element "), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace hauberk::test
