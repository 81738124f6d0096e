/// The ladder of activation distances.

#include <hauberk/mechanics/locking.hpp>

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

TEST(Stages, EndAtTheLastAndFallByTheRatio)
{
  for (const double last : {0.03, 0.02, 3e-3, 2.9e-3, 1e-3, 5e-5, 2e-9}) {
    Schedule s;
    s.last = last;
    const std::vector<double> g = activation_distances(s);
    EXPECT_EQ(g.back(), last);
    EXPECT_LE(g.front(), s.first * 1.001);
    EXPECT_GT(g.front(), s.first * s.ratio * 1.001) << "one more stage would have fitted";
    for (std::size_t k = 1; k < g.size(); ++k) EXPECT_NEAR(g[k] / g[k - 1], s.ratio, 1e-12);
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
