/// The ladder of activation distances.

#include <hauberk/mechanics/locking.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::test {
namespace {

TEST(Stages, FallFromTheFirstToTheLastByEqualFactors)
{
  for (const double last : {0.03, 0.02, 3e-3, 2.9e-3, 1e-3, 5e-5, 2e-9}) {
    Schedule s;
    s.last = last;
    const std::vector<double> g = activation_distances(s);
    EXPECT_EQ(g.back(), last);
    EXPECT_EQ(g.front(), s.first);
    for (std::size_t k = 1; k < g.size(); ++k) {
      EXPECT_GE(g[k] / g[k - 1], s.ratio * (1.0 - 1e-6));
      EXPECT_NEAR(g[k] / g[k - 1], g[1] / g[0], 1e-12);
    }
    // No more of them than that needs.
    const double all = s.last / s.first, steps = static_cast<double>(g.size()) - 1.0;
    if (steps > 1.0) {
      EXPECT_LT(std::pow(all, 1.0 / (steps - 1.0)), s.ratio);
    }
  }
}

TEST(Stages, OneStageWhereFirstIsLast)
{
  Schedule s;
  s.first = s.last = 2e-5;
  EXPECT_EQ(activation_distances(s), std::vector<double>{2e-5});
}

}  // namespace
}  // namespace hauberk::test
