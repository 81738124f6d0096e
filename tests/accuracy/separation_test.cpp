// Certified separation against brute force.

#include "geometry/separation.hpp"

#include "counts.hpp"
#include "random_pairs.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hauberk::brute {
namespace {

/// What brute force resolves: descent ends at rounding, coordinates of size 10.
constexpr double resolved = 1e-10;
/// Distance by brute force; where the kernel saw something closer both tori are probed, which also finds one
/// tube inside the other.
double brute_distance(const TorusPair& p, double upper)
{
  const double d = surface_distance(p.a, p.b);
  return upper < d - resolved ? std::min(d, solid_distance(p.a, p.b)) : d;
}

/// Stated rounding of the certified bound, with lengths up to 30.
constexpr double rounding = 1e-13;

TEST(Separation, BoundsTheBruteForceDistanceFromBothSides)
{
  const double infinite = std::numeric_limits<double>::infinity();
  Sample tightness, above, evaluations;
  long separate = 0, overlapping = 0, worst_pair = 0;
  double most_evaluations = 0.0;
  for (long k = 0; k < pair_count(); ++k) {
    const TorusPair p = random_pair(k);
    const Body A = kernel_body(p.a), B = kernel_body(p.b);
    const Separation s = separation(A, kernel_pose(p.a), B, kernel_pose(p.b), 0.0, infinite);
    const double d = brute_distance(p, s.upper);
    const std::string what = fmt::format("pair {} ({}), brute force {:.3e}", k, name(p.family), d);
    if (d <= 0.0) {
      ++overlapping;
      EXPECT_LE(s.lower, s.upper) << what;
      EXPECT_LE(s.upper, rounding) << what;
      continue;
    }
    EXPECT_LE(s.lower, d + rounding) << what;
    ++separate;
    EXPECT_GE(s.upper, d - resolved) << what;
    EXPECT_GE(s.lower, 0.5 * s.upper - rounding) << what;
    tightness.add(s.lower / d);
    above.add(s.upper / d);
    evaluations.add(s.evaluations);
    if (s.evaluations > most_evaluations) {
      most_evaluations = s.evaluations;
      worst_pair = k;
    }
  }
  fmt::print(
      "separation: {} pairs apart, {} overlapping\n  lower/distance  {}\n  upper/distance  {}\n"
      "  evaluations     {} (pair {})\n",
      separate, overlapping, tightness.summary(), above.summary(), evaluations.summary(), worst_pair);
  EXPECT_GT(separate, 10 * overlapping);
}

TEST(Separation, KeepsItsPromiseForClearanceTightnessAndEnough)
{
  for (long k = 0; k < pair_count() / 4; ++k) {
    const TorusPair p = random_pair(k);
    const Body A = kernel_body(p.a), B = kernel_body(p.b);
    const double d = brute_distance(p, separation(A, kernel_pose(p.a), B, kernel_pose(p.b), 0.0, 0.0).upper);
    const double clearance = 0.3 * std::max(d, 0.0), enough = 0.05, tight = 0.9;
    const Separation s = separation(A, kernel_pose(p.a), B, kernel_pose(p.b), clearance, enough, tight);
    const std::string what = fmt::format("pair {} ({})", k, name(p.family));
    EXPECT_LE(s.lower, std::max(d, 0.0) - clearance + rounding) << what;
    if (d > 0.0) {
      EXPECT_GE(s.upper, d - clearance - resolved) << what;
      EXPECT_GE(s.lower, std::min(enough, tight * s.upper) - rounding) << what;
    }
  }
}

TEST(Separation, LinkingNumberIsGausssIntegral)
{
  long linked = 0;
  for (long k = 0; k < pair_count() / 4; ++k) {
    const TorusPair p = random_pair(k);
    if (surface_distance(p.a, p.b, {256, 48, 24}) <= 0.0) continue;
    const int number = linking_number(kernel_body(p.a), kernel_pose(p.a), kernel_body(p.b), kernel_pose(p.b));
    EXPECT_EQ(std::abs(number), std::abs(gauss_linking(p.a, p.b))) << "pair " << k << ' ' << name(p.family);
    linked += number != 0;
  }
  EXPECT_GT(linked, pair_count() / 40);
}

}  // namespace
}  // namespace hauberk::brute
