// A cell vector along which nothing is linked has a length that changes nothing.

#include "limit_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::brute {
namespace {

constexpr std::array<double, 3> larger{5, 0.7, 0.7}, smaller{4, 0.5, 0.5};
/// Values agree to what the rounding of lengths does to a strain.
constexpr double rounding = 1e-13;

/// The chain along x, its idle vector as given.
SceneSpec chain_beside(const Vec3& idle)
{
  SceneSpec scene = slack_chain(larger, smaller);
  scene.lattice[1] = idle;
  return scene;
}

/// A scene turned by 90 degrees about z, its vectors in the other order.
SceneSpec turned(SceneSpec scene)
{
  const Mat3 Q = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  for (PlacedElement& e : scene.elements) e.rest = {Q * e.rest.position, Q * e.rest.rotation};
  for (Vec3& t : scene.lattice) t = Q * t;
  std::swap(scene.lattice[0], scene.lattice[1]);
  return scene;
}

TEST(IdleLength, ChangesNoLimitOfAChain)
{
  const double exact = 1.0 / 0.95 - 1.0;
  const double first = *limit(chain_beside({0, 1e2, 0}), 0.0, Sense::positive).value;
  EXPECT_NEAR(first, exact, 1e-9);
  for (double length = 1e2; length < 2e8; length *= 10.0) {
    for (const double lean : {0.0, 3.0}) {
      const SceneSpec scene = chain_beside({lean, length, 0});
      const LimitResult along = limit(scene, 0.0, Sense::positive);
      ASSERT_EQ(along.status, LimitStatus::locked) << length << ": " << along.message;
      EXPECT_NEAR(*along.value, first, rounding) << length;
      const LimitResult other = limit(turned(scene), 90.0, Sense::positive);
      ASSERT_EQ(other.status, LimitStatus::locked) << length << ": " << other.message;
      EXPECT_NEAR(*other.value, first, 1e-10) << length;
    }
  }
}

/// Half of the vector counts where links run along it, in a repeated cell as in its double.
TEST(IdleLength, IsNotThatOfALinkedVector)
{
  const test::Sheet sheet(2);
  const Model one = make_model(test::chainmail(2, 2), sheet, 0.0),
              four = make_model(test::chainmail(4, 4), sheet, 0.0);
  EXPECT_NEAR(four.metric[0], 4.0 * one.metric[0], 1e-12 * four.metric[0]);
  const Model chain = make_model(chain_beside({0, 1e6, 0}), sheet, 0.0);
  EXPECT_LT(chain.metric[1], 10.0);
}

}  // namespace
}  // namespace hauberk::brute
