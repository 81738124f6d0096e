// The published searches by samples, which guarantee nothing: how often they miss, and that what they find is
// real.

#include <scenes.hpp>
#include "contact/formulation.hpp"
#include "contact/published.hpp"
#include "counts.hpp"
#include "motion/advancement.hpp"
#include "moving_scene.hpp"
#include "random_pairs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

TEST(Sampled, NearestOfTheSampledMinima)
{
  constexpr double same_distance = 1e-9;
  long pairs = 0, further = 0;
  std::array<long, family_count> missed{};
  for (long k = 0; k < pair_count(); ++k) {
    const TorusPair pair = random_pair(k);
    const Body a = kernel_body(pair.a), b = kernel_body(pair.b);
    const PairFrame frame(a, kernel_pose(pair.a), b, kernel_pose(pair.b));
    int evaluations = 0;
    const double exact = surface_distance(pair.a, pair.b);
    if (exact <= 1e-6) continue;  // overlapping draws; and there the sampled distance is zero
    ++pairs;
    const auto found = published::sampled_minima(frame, evaluations);
    ASSERT_FALSE(found.empty());
    const double distance = std::sqrt(found.front().d);
    EXPECT_GT(distance, exact - same_distance) << "pair " << k;
    if (distance > exact + same_distance) {
      ++further;
      ++missed[static_cast<std::size_t>(pair.family)];
    }
  }
  fmt::print("sampled minima: {} pairs, nearest minimum missed {}:", pairs, further);
  for (int f = 0; f < family_count; ++f) fmt::print(" {} {}", name(static_cast<Family>(f)), missed[f]);
  fmt::print("\n");
  ASSERT_GT(pairs, pair_count() / 2);
  EXPECT_LE(further, pairs / 100);
}

TEST(Sampled, CollisionsAlongSteps)
{
  const test::Sheet sheet(3);
  long touching = 0, missed = 0, cut = 0, motions = 0;
  for (long k = 0; k < motion_count(); ++k) {
    std::seed_seq seed{k, 79L};
    std::mt19937_64 rng(seed);
    const RandomScene scene = random_scene(k, rng);
    const Model m = make_model(scene.spec, sheet, 0.0);
    const State from = rest_state(m);
    const Vector dy = random_step(m, from, (k / 2) % 2 == 0, rng);
    const SafeStep safe = sampled_safe_step(m, from, dy, 1e-8);
    ASSERT_GE(safe.alpha, 0.0);
    ASSERT_LE(safe.alpha, 1.0);
    const TorusAt at = [&](int body, const Image& image, double s) {
      const Body& b = m.bodies[body];
      return from_kernel(b, image_pose(m, advanced(m, from, dy, s), b.element, image));
    };
    const Watched w = watch(m, at, 0.1, safe.alpha);
    ++motions;
    touching += w.contact ? 1 : 0;
    cut += safe.alpha < 1.0 ? 1 : 0;
    missed += (w.contact && *w.contact < safe.alpha) || w.smallest <= 0.0 ? 1 : 0;
  }
  fmt::print("sampled collision check: {} motions, {} through something, {} cut, {} collisions missed\n",
             motions, touching, cut, missed);
  EXPECT_GT(touching, motions / 4);
  EXPECT_LE(missed, motions / 50);
}

}  // namespace
}  // namespace hauberk::brute
