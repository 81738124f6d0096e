/// Pairs of a strip that a step may bring together, against a look at all of them along the whole step.

#include "loadcases/strip_roll/strip_roll.hpp"
#include "motion/track.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <tuple>

namespace hauberk::test {
namespace {

/// Rings of several sizes in rows of a strip, whose vector is as short as a ring is wide.
SceneSpec strip()
{
  SceneSpec scene;
  scene.types.push_back({"ring", std::make_shared<Rings>()});
  scene.lattice = {Vec3(2.5, 0.0, 0.0)};
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int row = 0; row < 6; ++row) {
    PlacedElement e;
    e.parameters = {1.0 + 0.3 * u(rng), 0.1, 0.1};
    e.rest = {Vec3(u(rng), 2.0 * row - 5.0, 0.2 * u(rng)), random_rotation(rng)};
    scene.elements.push_back(std::move(e));
  }
  return scene;
}

using Pair = std::tuple<int, int, Image>;

/// Pairs whose spheres come within the clearance of each other at one of many places of the step.
std::set<Pair> that_meet(const Model& m, const State& from, const Vector& dy)
{
  constexpr int places = 20, images = 8;
  std::set<Pair> out;
  for (int s = 0; s <= places; ++s) {
    const State there = advanced(m, from, dy, static_cast<double>(s) / places);
    for (int i = 0; i < m.element_count(); ++i) {
      const Vec3 x = image_pose(m, there, i, {}).position;
      for (int j = i; j < m.element_count(); ++j) {
        for (int n = i == j ? 1 : -images; n <= images; ++n) {
          const Vec3 y = image_pose(m, there, j, {n, 0}).position;
          if ((x - y).norm() < m.reach[i] + m.reach[j] + m.clearance) out.insert({i, j, Image{n, 0}});
        }
      }
    }
  }
  return out;
}

TEST(StripPairs, NoneIsMissed)
{
  const StripRoll load(false, true);
  const Model m = make_model(strip(), load, 0.01);
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  State from = rest_state(m);
  std::size_t met = 0, met_by_short = 0, found_by_short = 0;
  for (int repeat = 0; repeat < 90; ++repeat) {
    from.macro << 0.5 * u(rng), 0.4 * u(rng);
    for (Eigen::Index k = 0; k < from.e.size(); ++k) from.e[k] = 2.0 * u(rng);
    const std::array sizes{0.02, 0.2, 2.0};
    const bool is_short = repeat % 3 == 0;
    Vector dy(m.dofs());
    for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = sizes[static_cast<std::size_t>(repeat % 3)] * u(rng);
    dy.head<2>() *= 0.3;
    // Some steps strain by so much that the lattice's change bounds nothing.
    if (repeat % 5 == 1) dy[0] = 1.5;
    std::set<Pair> found;
    for (const CandidatePair& pair : candidate_pairs(m, from, dy))
      found.insert({pair.ti.element, pair.tj.element, pair.tj.image});
    const std::set<Pair> meet = that_meet(m, from, dy);
    for (const auto& [i, j, image] : meet)
      EXPECT_TRUE(found.contains({i, j, image}))
          << repeat << ": " << i << ", " << j << " [" << image[0] << ']';
    met += meet.size();
    if (is_short && repeat % 5 != 1) met_by_short += meet.size(), found_by_short += found.size();
  }
  EXPECT_GT(met, 500U);
  EXPECT_LT(found_by_short, 1.5 * static_cast<double>(met_by_short)) << "of " << met_by_short;
}

}  // namespace
}  // namespace hauberk::test
