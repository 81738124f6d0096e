/// Steps of meshes that are called free of collisions, against many small ones.

#include <scenes.hpp>
#include "contact/mesh.hpp"
#include "geometry/facets.hpp"
#include "model/links.hpp"
#include "motion/advancement.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk::test {
namespace {

constexpr double keep = 0.1;

/// Smallest distance of the ring and all images of the other that may touch it; 0 where meshes intersect.
double smallest(const Model& m, const State& s)
{
  double out = std::numeric_limits<double>::infinity();
  for (const ElementPair& pair : near_pairs(m, s, 0.5)) {
    const PairFrame frame(m.bodies[pair.i], image_pose(m, s, pair.i, {0, 0}), m.bodies[pair.j],
                          image_pose(m, s, pair.j, pair.image));
    if (facets_intersect(frame)) return 0.0;
    out = std::min(out, smallest_feature_distance(frame, 0.5));
  }
  return out;
}

TEST(FacetAdvancement, NothingIsMissedAndLittleGivenAway)
{
  const Sheet load(3);
  SceneSpec spec = chain({5, 0.7, 0.7}, {4.6, 0.7, 0.9}, 15.5);
  spec.facets = 12;
  const Model m = make_model(spec, load, 0.0);
  const State rest = rest_state(m);
  const double at_rest = smallest(m, rest);
  ASSERT_GT(at_rest, 0.0);
  std::mt19937_64 rng(2);
  std::normal_distribution<double> normal;
  int cut = 0, whole = 0;
  std::vector<double> tightness;
  for (int trial = 0; trial < 60; ++trial) {
    Vector dy(m.dofs());
    const double size = trial % 2 == 0 ? 0.04 : 0.4;
    for (int k = 0; k < m.dofs(); ++k) dy[k] = (k < 3 ? 0.2 : 1.0) * size * normal(rng);
    const SafeStep safe = largest_safe_step(m, rest, dy, keep);
    ASSERT_GT(safe.alpha, 0.0);
    constexpr int steps = 400;
    double first_near = 2.0, least = at_rest;
    for (int k = 1; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      if (!load.admissible({rest.macro.data(), 3})) break;
      const double gap = smallest(m, advanced(m, rest, dy, s));
      if (s <= safe.alpha) least = std::min(least, gap);
      if (gap <= 2.0 * keep * at_rest) {
        first_near = s;
        break;
      }
    }
    EXPECT_GT(least, 0.0) << "trial " << trial << ": a collision before " << safe.alpha;
    if (safe.alpha < 1.0) {
      EXPECT_GE(least, 0.999 * keep * at_rest) << "trial " << trial;
    }
    EXPECT_TRUE(links_kept(m, advanced(m, rest, dy, safe.alpha)));
    if (safe.alpha >= 1.0) {
      ++whole;
    } else {
      ++cut;
      EXPECT_LE(first_near, 1.0) << "trial " << trial << " was cut to " << safe.alpha << " for nothing";
      tightness.push_back(safe.alpha / first_near);
    }
  }
  EXPECT_GT(cut, 10);
  EXPECT_GT(whole, 10);
  std::nth_element(tightness.begin(), tightness.begin() + static_cast<std::ptrdiff_t>(tightness.size() / 2),
                   tightness.end());
  EXPECT_GT(tightness[tightness.size() / 2], 0.95);
}

}  // namespace
}  // namespace hauberk::test
