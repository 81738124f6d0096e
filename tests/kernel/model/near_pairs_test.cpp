/// Pairs of elements that are near, against a look at every element and image.

#include "model/near_pairs.hpp"

#include "model/model.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace hauberk::test {
namespace {

using Key = std::tuple<int, int, Image>;

std::vector<Key> keys(const std::vector<ElementPair>& pairs)
{
  std::vector<Key> out;
  out.reserve(pairs.size());
  for (const ElementPair& p : pairs) out.emplace_back(p.i, p.j, p.image);
  return out;
}

/// In the order that is promised: by i, j, image.
std::vector<Key> one_by_one(const Model& m, const State& s, double margin, int images)
{
  std::vector<Key> out;
  for (int i = 0; i < m.element_count(); ++i) {
    const Vec3 at = image_pose(m, s, i, {0, 0}).position;
    for (int j = i; j < m.element_count(); ++j) {
      const double r = m.reach[i] + m.reach[j] + margin;
      for (int k = -images; k <= images; ++k) {
        for (int l = -images; l <= images; ++l) {
          if (i == j && (k < 0 || (k == 0 && l <= 0))) continue;
          if ((image_pose(m, s, j, {k, l}).position - at).norm() < r) out.emplace_back(i, j, Image{k, l});
        }
      }
    }
  }
  return out;
}

/// Strained, sheared and displaced by up to `away`.
State moved(const Model& m, double away, std::uint64_t seed)
{
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  State s = rest_state(m);
  for (int k = 0; k < m.macro_count; ++k) s.macro[k] = 0.25 * uniform(rng);
  for (Eigen::Index k = 0; k < s.e.size(); ++k) s.e[k] = away * uniform(rng);
  return s;
}

TEST(NearPairs, OfSheets)
{
  const Sheet load(3);
  // 2 elements: one by one; 72 of 6 x 6 cells and 128 of 16 x 4: buckets, or too few of them along a side.
  for (const auto& [a, b] : {std::array{1, 1}, std::array{6, 6}, std::array{16, 4}, std::array{2, 40}}) {
    const Model m = make_model(chainmail(a, b), load, 0.0);
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const State s = moved(m, seed < 3 ? 0.2 : 4.0, seed);
      for (const double margin : {0.0, 0.7}) {
        const std::vector<Key> expected = one_by_one(m, s, margin, a * b == 1 ? 14 : 6);
        EXPECT_GT(expected.size(), static_cast<std::size_t>(m.element_count()));
        EXPECT_EQ(keys(near_pairs(m, s, margin)), expected) << a << " x " << b << ", seed " << seed;
      }
    }
  }
}

/// Elements scattered in space, without a lattice.
TEST(NearPairs, OfPatches)
{
  const Sheet load(3);
  SceneSpec spec = chainmail(12, 8);
  spec.lattice.clear();
  const Model m = make_model(spec, load, 0.0);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const State s = moved(m, 3.0, seed);
    const std::vector<Key> expected = one_by_one(m, s, 0.3, 0);
    EXPECT_GT(expected.size(), 100U);
    EXPECT_EQ(keys(near_pairs(m, s, 0.3)), expected);
  }
}

}  // namespace
}  // namespace hauberk::test
