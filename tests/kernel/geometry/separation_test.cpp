/// Special arrangements that are hard for a certified distance; random ones are in tests/accuracy.

#include "geometry/separation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hauberk::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Body torus(double R, double r0, double r1)
{
  Primitive p;
  p.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  p.size = {R, r0, r1};
  return make_body(p, 0, 0, 1.0);
}

/// A tube inside of another's touches nothing, but no fabric is made like that.
TEST(Separation, OneInsideTheOtherOverlaps)
{
  const Body outer = torus(1.0, 0.5, 0.6), round = torus(1.0, 0.5, 0.5);
  for (const Body& inner : {torus(1.1, 0.1, 0.2), torus(1.1, 0.1, 0.1)}) {
    for (const Body& around : {outer, round}) {
      for (const double clearance : {0.0, 0.05}) {
        const Separation s = separation(around, {}, inner, {}, clearance, infinite);
        const Separation t = separation(inner, {}, around, {}, clearance, infinite);
        EXPECT_LT(s.upper, -0.1 - clearance);
        EXPECT_LE(s.lower, s.upper);
        EXPECT_LT(t.upper, -0.1 - clearance);
        EXPECT_LE(t.lower, t.upper);
      }
    }
  }
}

/// Two equal rings on each other, all around as near as rounding allows: no gap, and found out soon.
TEST(Separation, ConformingSurfacesAtRoundingAreBoundedWork)
{
  const Body ring = torus(1.0, 0.1, 0.1);
  for (const double gap : {1e-15, 2e-15, 1e-14, 1e-12}) {
    Pose above;
    above.position.z() = 0.2 + gap;
    const Separation s = separation(ring, {}, ring, above, 0.0, infinite);
    EXPECT_LE(s.evaluations, 2100000) << gap;
    EXPECT_LE(s.lower, gap + 1e-15);
    EXPECT_GE(s.lower, 0.0) << gap;
    EXPECT_LE(s.upper, gap + 1e-15) << gap;
  }
}

}  // namespace
}  // namespace hauberk::test
