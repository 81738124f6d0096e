/// The smallest gap, against all of them.

#include "equilibrium/gaps.hpp"

#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace hauberk::test {
namespace {

double least_of_all(const Model& m, const State& s, double range)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Gap& gap : find_gaps(m, s, range, false)) least = std::min(least, gap.gap);
  return least;
}

TEST(SmallestGap, IsTheLeastOfAllThatAreInRange)
{
  const Sheet load(3);
  const Model m = make_model(chainmail(1, 1), load, 0.0);
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int apart = 0;
  for (int trial = 0; trial < 40; ++trial) {
    State s = rest_state(m);
    for (int k = 0; k < m.macro_count; ++k) s.macro[k] = 0.02 * uniform(rng);
    for (Eigen::Index k = 0; k < s.e.size(); ++k) s.e[k] = 0.01 * uniform(rng);
    const double gap = least_of_all(m, s, 1.0);
    EXPECT_NEAR(smallest_gap(m, s, 1.0), gap, 1e-13);
    if (gap <= 0.0) continue;
    ++apart;
    // Nearer than a thousandth of the range, further than that, and out of range.
    EXPECT_NEAR(smallest_gap(m, s, 5000.0 * gap), gap, 1e-13);
    EXPECT_NEAR(smallest_gap(m, s, 1.5 * gap), gap, 1e-13);
    EXPECT_EQ(smallest_gap(m, s, 0.9 * gap), std::numeric_limits<double>::infinity());
  }
  EXPECT_GT(apart, 10);
  EXPECT_LT(apart, 40) << "some overlap";
}

}  // namespace
}  // namespace hauberk::test
