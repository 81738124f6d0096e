/// What targets and bounds ask of a value.

#include "design/target.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hauberk::test {
namespace {

TEST(Bounds, ShareTheDifferenceBetweenThem)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    const double target = number(random), value = number(random);
    const double further = miss(Aim::no_further, target, value), nearer = miss(Aim::no_nearer, target, value);
    EXPECT_EQ(further + nearer, value - target);
    EXPECT_EQ(further * nearer, 0.0) << "a value is on one side of a bound";
    EXPECT_EQ(miss(Aim::reach, target, value), value - target);
    EXPECT_EQ(miss(Aim::no_further, -target, -value), -further) << "further is away from zero";
    EXPECT_GE(further * target, 0.0) << "what is too far is too far on the target's side of zero";
  }
}

TEST(Bounds, AreKeptByValuesOnTheirNearSide)
{
  EXPECT_EQ(miss(Aim::no_further, 0.2, -0.5), 0.0);
  EXPECT_EQ(miss(Aim::no_further, -0.2, -0.1), 0.0);
  EXPECT_DOUBLE_EQ(miss(Aim::no_further, -0.2, -0.3), -0.1);
  EXPECT_DOUBLE_EQ(miss(Aim::no_nearer, 0.2, 0.1), -0.1);
  EXPECT_TRUE(std::isnan(miss(Aim::no_further, 0.2, std::numeric_limits<double>::quiet_NaN())))
      << "what has no value keeps no bound";
}

TEST(Bounds, AreMetToAThousandthAndValuesToATwentieth)
{
  const auto met = [](Aim aim, double value) { return is_within(met_share(aim), aim, -0.2, value); };
  EXPECT_TRUE(met(Aim::reach, -0.2099));
  EXPECT_FALSE(met(Aim::reach, -0.2101));
  EXPECT_TRUE(met(Aim::no_further, -0.20019));
  EXPECT_FALSE(met(Aim::no_further, -0.20021));
  EXPECT_TRUE(met(Aim::no_further, 0.3));
  EXPECT_TRUE(met(Aim::no_nearer, -0.9));
  EXPECT_FALSE(met(Aim::no_nearer, -0.1997));
}

}  // namespace
}  // namespace hauberk::test
