/// Discontinuities of known functions: found however small, and not found where a function is only steep.

#include "tasks/transition/jumps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk {
namespace {

constexpr int intervals = 64, splits = 400;

/// tanh((s - at)/width), and its force, with slopes.
PathPoint steep(double s, double at, double width)
{
  const double t = std::tanh((s - at) / width), d = (1.0 - t * t) / width;
  PathPoint p;
  p.s = s;
  p.energy = t;
  p.slope = d;
  p.gradient[4] = d;
  p.gradient_slope[4] = -2.0 * t * d / width;
  return p;
}

TEST(Jumps, SteepIsNoJump)
{
  for (const double width : {1.0, 1e-2, 1e-4}) {
    const auto f = [width](double s) { return steep(s, 0.3217, width); };
    const Jump energy = largest_jump(f, Quantity::energy, intervals, splits);
    EXPECT_EQ(energy.size, 0.0) << width;
    EXPECT_LT(energy.resolution, 1e-10) << width;
    const Jump force = largest_jump(f, Quantity::force, intervals, splits);
    EXPECT_EQ(force.size, 0.0) << width;
    EXPECT_LT(force.resolution, 1e-9 / width) << width;
  }
}

TEST(Jumps, FindsASmallJumpOnASteepSlope)
{
  const double at = 0.51234;
  for (const double size : {1.0, 1e-3, 1e-8}) {
    const auto f = [at, size](double s) {
      PathPoint p = steep(s, 0.5, 0.05);
      if (s > at) {
        p.energy -= size;
        p.gradient[1] += 2.0 * size;
      }
      return p;
    };
    const Jump energy = largest_jump(f, Quantity::energy, intervals, splits);
    EXPECT_NEAR(energy.size, size, 1e-6 * size + 1e-14);
    EXPECT_NEAR(energy.at, at, 1e-9);
    const Jump force = largest_jump(f, Quantity::force, intervals, splits);
    EXPECT_NEAR(force.size, 2.0 * size, 1e-6 * size + 1e-12);
    EXPECT_NEAR(force.at, at, 1e-9);
    EXPECT_LT(energy.resolution, 1e-9);
  }
}

/// A kink and a root are continuous, though a slope is infinite and one is undefined.
TEST(Jumps, KinksAndRootsAreContinuous)
{
  const auto f = [](double s) {
    PathPoint p;
    p.s = s;
    const double x = s - 0.4321;
    p.energy = std::sqrt(std::abs(x));
    p.slope = std::copysign(0.5 / p.energy, x);
    p.gradient[0] = std::abs(x);
    p.gradient_slope[0] = std::copysign(1.0, x);
    return p;
  };
  const Jump energy = largest_jump(f, Quantity::energy, intervals, splits);
  EXPECT_LT(energy.size, 1e-4) << "the root of the narrowest interval";
  const Jump force = largest_jump(f, Quantity::force, intervals, splits);
  EXPECT_LT(std::max(force.size, force.resolution), 1e-8);
}

TEST(Jumps, TheLargestOfSeveralCounts)
{
  const auto f = [](double s) {
    PathPoint p;
    p.s = s;
    for (const double at : {0.1, 0.2, 0.7}) p.energy += s >= at ? at : 0.0;
    return p;
  };
  const Jump jump = largest_jump(f, Quantity::energy, intervals, splits);
  EXPECT_NEAR(jump.size, 0.7, 1e-15);
  EXPECT_NEAR(jump.at, 0.7, 1e-9);
  EXPECT_EQ(jump.resolution, 0.0);
}

}  // namespace
}  // namespace hauberk
