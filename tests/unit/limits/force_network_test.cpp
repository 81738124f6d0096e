/// Which locked states count as one: forces and strain up to symmetries, whatever rattlers do.

#include "symmetric_scenes.hpp"

#include "loadcases/in_plane_periodic/in_plane_periodic.hpp"

#include <hauberk/limits/force_network.hpp>
#include <hauberk/mechanics/gaps.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk::test {
namespace {

const InPlanePeriodic flat(StrainMeasure::tensor, {}, {false, false});

struct LockedAt {
  Locked locked;
  ForceNetwork network;
};

ForceNetwork network_of(const Model& m, const State& s, const Stage& stage)
{
  Request request;
  request.order = 1;
  request.points = true;
  const ContactEnergy e = contact_energy(m, s, stage_pairs(m, s, stage), stage.contact, request);
  return force_network(m, s, e.points, stage.mu);
}

LockedAt locked_at(const Model& m, double degrees, Sense sense, std::uint64_t seed)
{
  LimitSettings settings;
  settings.seed = seed;
  LockedAt out;
  out.locked = limit_from_start(m, {Direction::at_degrees(degrees), sense}, settings, 0, [] { return true; });
  EXPECT_EQ(out.locked.status, LockStatus::locked) << out.locked.message;
  out.network = network_of(m, out.locked.state, out.locked.stage);
  return out;
}

/// The threefold element stretched at 10 and, mirrored, at 50 degrees.
TEST(ForceNetworks, OfEqualDirectionsAreEqual)
{
  const Model m = make_model(threefold_round(), flat, 0.0);
  const std::vector<SceneSymmetry> all = scene_symmetries(m), none{all.front()};
  const LockedAt a = locked_at(m, 10.0, Sense::positive, 1), again = locked_at(m, 10.0, Sense::positive, 2),
                 b = locked_at(m, 50.0, Sense::positive, 3), other = locked_at(m, 20.0, Sense::positive, 1);
  EXPECT_TRUE(same_fabric_state(m, none, a.network, again.network));
  EXPECT_TRUE(same_fabric_state(m, all, a.network, b.network));
  EXPECT_FALSE(same_fabric_state(m, none, a.network, b.network));
  EXPECT_FALSE(same_fabric_state(m, all, a.network, other.network));
  EXPECT_TRUE(rattlers(m, a.network).empty());
}

TEST(ForceNetworks, AreCarriedAsTheirStatesAre)
{
  const Model m = make_model(chainmail(2, 1), flat, 0.0);
  const LockedAt a = locked_at(m, 30.0, Sense::negative, 1);
  for (const SceneSymmetry& g : scene_symmetries(m)) {
    const std::optional<State> image = transformed(m, g, a.locked.state);
    ASSERT_TRUE(image);
    const ForceNetwork computed = network_of(m, *image, a.locked.stage);
    const ForceNetwork carried = *transformed(m, g, a.network);
    ASSERT_EQ(computed.pairs.size(), carried.pairs.size());
    // Gaps are about 1e-10, so that rounding of 1e-15 shows in the fifth digit of a barrier's force.
    for (std::size_t k = 0; k < carried.pairs.size(); ++k) {
      const ForceNetwork::Pair &p = computed.pairs[k], &q = carried.pairs[k];
      EXPECT_EQ(std::tie(p.i, p.j, p.image), std::tie(q.i, q.j, q.image));
      EXPECT_LT((p.force - q.force).norm(), 1e-4);
    }
    EXPECT_TRUE(same_fabric_state(m, std::vector{inverse(m, g)}, computed, a.network));
  }
}

/// A ring that nothing holds beside a chain, and rings turned about their own axes.
TEST(ForceNetworks, DoNotSeeRattlersAndSpins)
{
  SceneSpec scene = chain({5, 0.7, 0.7}, {5, 0.7, 0.7}, 13.0);
  PlacedElement loose = scene.elements.front();
  loose.rest.position = Vec3(0.0, 100.0, 0.0);
  scene.elements.push_back(loose);
  const Model m = make_model(scene, flat, 0.0);
  const LockedAt a = locked_at(m, 0.0, Sense::positive, 1);
  EXPECT_EQ(rattlers(m, a.network), std::vector<int>{2});
  State moved = a.locked.state;
  moved.e.segment<2>(4) += Eigen::Vector2d(3.0, -4.0);
  moved.rotation[2] = rotation_exp(Vec3(0.3, 0.8, -0.5));
  moved.rotation[0] = moved.rotation[0] * rotation_exp(Vec3(0.0, 0.0, 1.0));
  const std::vector<SceneSymmetry> all = scene_symmetries(m);
  ForceNetwork other = network_of(m, moved, a.locked.stage);
  EXPECT_TRUE(same_fabric_state(m, all, a.network, other));
  // Further apart in strain, or pressed elsewhere, they are two.
  other.macro[0] += 1e-4;
  EXPECT_FALSE(same_fabric_state(m, all, a.network, other));
  other.macro[0] -= 1e-4;
  ASSERT_FALSE(other.pairs.empty());
  other.pairs.front().force *= 0.9;
  EXPECT_FALSE(same_fabric_state(m, all, a.network, other));
  other.pairs.erase(other.pairs.begin());
  EXPECT_FALSE(same_fabric_state(m, all, a.network, other));
  EXPECT_FALSE(same_fabric_state(m, all, other, a.network));
}

/// A pair is the same from both of its elements.
TEST(ForceNetworks, KnowAPairFromBothSides)
{
  const Model m = make_model(chain({5, 0.7, 0.7}, {5, 0.7, 0.7}, 13.0), flat, 0.0);
  ContactEnergy::Point p;
  p.a = 0;
  p.b = 1;
  p.image = {-1, 0, 0};
  p.contact.on_p = p.contact.on_f = Vec3::Zero();
  p.contact.normal = Vec3::UnitX();
  p.contact.force = 2.0;
  ContactEnergy::Point q = p;
  std::swap(q.a, q.b);
  q.image = {1, 0, 0};
  q.contact.normal = -Vec3::UnitX();
  const std::vector<ContactEnergy::Point> both{p, q};
  const ForceNetwork n = force_network(m, rest_state(m), both, 0.5);
  ASSERT_EQ(n.pairs.size(), 1U);
  EXPECT_EQ(n.pairs[0].image, (Image{-1, 0, 0}));
  EXPECT_EQ(n.pairs[0].force, Vec3(2.0, 0.0, 0.0));
}

}  // namespace
}  // namespace hauberk::test
