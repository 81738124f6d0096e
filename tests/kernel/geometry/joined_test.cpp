/// Primitives of one element that hang together.

#include "geometry/joined.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

using Groups = std::vector<std::vector<int>>;

/// Rings of radius 5 and wire 0.7, around z or around y.
Primitive ring(double x, double z, bool upright = false)
{
  Primitive p;
  p.kind = PrimitiveKind::circle_tube;
  p.size = {5.0, 0.7, 0.7};
  p.position = Vec3(x, 0.0, z);
  if (upright) p.rotation = Eigen::AngleAxisd(0.5 * EIGEN_PI, Vec3::UnitX()).toRotationMatrix();
  return p;
}

TEST(Joined, PrimitivesHangTogetherDirectlyOrByOthers)
{
  EXPECT_EQ(joined_primitives({}), Groups());
  // Circles whose centres are 9 apart cross, those 18 apart do not.
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(18, 0)}), (Groups{{0}, {1}}));
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(18, 0), ring(9, 0)}), (Groups{{0, 1, 2}}));
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(40, 0), ring(9, 0), ring(49, 0)}),
            (Groups{{0, 2}, {1, 3}}));
  // Two groups that the last one joins.
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(9, 0), ring(27, 0), ring(36, 0), ring(18, 0)}),
            (Groups{{0, 1, 2, 3, 4}}));
}

/// Wires 1.4 thick that lie on each other touch, and nothing less than that counts; rings that are linked are
/// two.
TEST(Joined, LinksAndNeighboursAreApart)
{
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(0, 1.401)}), (Groups{{0}, {1}}));
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(0, 1.399)}), (Groups{{0, 1}}));
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(5, 0, true)}), (Groups{{0}, {1}}));
  EXPECT_EQ(joined_primitives(std::vector{ring(0, 0), ring(10, 0, true)}), (Groups{{0, 1}}));
}

}  // namespace
}  // namespace hauberk::test
