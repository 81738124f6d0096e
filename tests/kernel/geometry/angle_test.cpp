#include "geometry/pair_frame.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

void expect_close(const Angle& a, double radians, double tolerance)
{
  const auto exact = static_cast<long double>(radians);
  EXPECT_NEAR(a.c, static_cast<double>(std::cos(exact)), tolerance) << radians;
  EXPECT_NEAR(a.s, static_cast<double>(std::sin(exact)), tolerance) << radians;
  EXPECT_NEAR(a.c * a.c + a.s * a.s, 1.0, 1e-15) << radians;
}

TEST(Angle, EqualsTheLibrarysFunctionsToRounding)
{
  std::mt19937_64 rng(6);
  std::uniform_real_distribution<double> turns(-1.0, 1.0);
  for (const double width : {1e-8, 0.1, 7.0, 1e2, 1e6, 1e12}) {
    for (int k = 0; k < 5000; ++k) {
      const double radians = width * turns(rng);
      // The spacing of the table itself is rounded.
      expect_close(Angle(radians), radians, 5e-16 + (width <= 1e2 ? 4e-17 * width : 0.0));
    }
  }
  // Halfway between entries of the table, and on them.
  for (int k = -600; k <= 600; ++k)
    expect_close(Angle(k * std::numbers::pi / 256.0), k * std::numbers::pi / 256.0, 2e-15);
}

TEST(Angle, TurnsByAnyAngle)
{
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> turns(-1.0, 1.0);
  for (int k = 0; k < 5000; ++k) {
    const double from = 3.0 * turns(rng), by = (k % 2 == 0 ? 0.3 : 6.0) * turns(rng);
    expect_close(Angle(from).turned(by), from + by, 3e-15);
  }
}

}  // namespace
}  // namespace hauberk::test
