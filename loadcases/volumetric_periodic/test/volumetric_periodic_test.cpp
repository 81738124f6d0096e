/// Which limits exist, and positions against the matrix that they stand for. What every load case has to keep
/// is tested by the conformance kit.

#include "../volumetric_periodic.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

TEST(VolumetricPeriodic, PositionsAreThoseOfASymmetricMatrix)
{
  const VolumetricPeriodic load;
  ASSERT_EQ(load.lattice_vectors(), 3);
  const std::vector<double> macro{0.1, -0.2, 0.3, 0.04, 0.05, -0.06}, e{0.01, 0.02, 0.03};
  Mat3 F;
  F << 1.1, -0.06, 0.05, -0.06, 0.8, 0.04, 0.05, 0.04, 1.3;
  const Vec3 X(1.0, -2.0, 0.5), T(3.0, 0.0, 1.0);
  PositionMap map;
  load.position(macro, e, X, T, map);
  EXPECT_LT((map.x - F * (X + T) - Vec3(0.01, 0.02, 0.03)).norm(), 1e-14);
  const auto [least, most] = load.stretch_range(macro);
  std::mt19937_64 rng(1);
  std::normal_distribution<double> normal;
  double shortest = 10.0, longest = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 n = Vec3(normal(rng), normal(rng), normal(rng)).normalized();
    shortest = std::min(shortest, (F * n).norm());
    longest = std::max(longest, (F * n).norm());
  }
  EXPECT_LE(least, shortest);
  EXPECT_GE(most, longest);
  EXPECT_NEAR(least, shortest, 1e-3);
  EXPECT_NEAR(most, longest, 1e-3);
}

/// Whatever moves states, turns them as it turns the positions of their elements.
TEST(VolumetricPeriodic, TransformsWithEveryIsometry)
{
  const VolumetricPeriodic load;
  const std::vector<double> macro{0.1, -0.2, 0.3, 0.04, 0.05, -0.06}, none(3, 0.0);
  std::vector<double> out(6);
  const Vec3 X(1.0, -2.0, 0.5), T(3.0, 0.0, 1.0);
  const Mat3 turn = rotation_exp(Vec3(0.3, -1.1, 0.7));
  for (const Mat3& O : {turn, Mat3(-turn)}) {
    ASSERT_TRUE(load.transform(O, macro, out));
    PositionMap before, after;
    load.position(macro, none, X, T, before);
    load.position(out, none, O * X, O * T, after);
    EXPECT_LT((after.x - O * before.x).norm(), 1e-14);
  }
}

TEST(VolumetricPeriodic, LinksThatSpanLessThanSpaceBoundLess)
{
  const VolumetricPeriodic load;
  using Components = std::vector<double>;
  const auto bounded = [&load](const Components& d, const std::vector<Vec3>& cycles) {
    std::vector<double> t(6);
    load.load(Direction::along(d), t);
    return load.boundedness(t, cycles);
  };
  const std::vector<Vec3> none, chain{Vec3(3, 0, 0)}, twice{Vec3(3, 0, 0), Vec3(-6, 0, 0)},
      sheet{Vec3(3, 0, 0), Vec3(1, 2, 0)}, solid{Vec3(3, 0, 0), Vec3(1, 2, 0), Vec3(0, 1, 4)};
  for (const Components& d : {Components{1, 0, 0, 0, 0, 0}, Components{0, -1, 0, 0, 1, 0},
                              Components{-1, -1, -1, 0, 0, 0}, Components{0, 0, 0, 1, 0, 0}})
    EXPECT_EQ(bounded(d, solid), Boundedness::attained);
  const Components along{1, 0, 0, 0, 0, 0}, against{-1, 0, 0, 0, 0, 0}, across{0, 0, 1, 0, 0, 0},
      flatter{0, 0, -1, 0, 0, 0}, shear{0, 0, 0, 1, 0, 0}, smaller{-1, -1, -1, 0, 0, 0};
  for (const auto& cycles : {chain, twice}) {
    EXPECT_EQ(bounded(along, cycles), Boundedness::attained);
    EXPECT_EQ(bounded(against, cycles), Boundedness::not_attained);
    EXPECT_EQ(bounded(across, cycles), Boundedness::unbounded);
    EXPECT_EQ(bounded(shear, cycles), Boundedness::unbounded) << "stretches (0, 1, 1)";
    EXPECT_EQ(bounded(smaller, cycles), Boundedness::attained);
  }
  // As cells spread along z they may get flatter in y (or x), which the load wants, for ever.
  EXPECT_EQ(bounded({1, -1, 0, 0, 0, 0}, chain), Boundedness::not_attained);
  EXPECT_EQ(bounded({0, 0, 0, 0, 1, 0}, chain), Boundedness::not_attained);
  EXPECT_EQ(bounded({1, 0, 0, 1, 0, 0}, sheet), Boundedness::not_attained);
  EXPECT_EQ(bounded({1, 0, 0, 0, 1, 0}, chain), Boundedness::attained) << "chains that turn";
  EXPECT_EQ(bounded(along, sheet), Boundedness::attained);
  EXPECT_EQ(bounded(across, sheet), Boundedness::unbounded);
  EXPECT_EQ(bounded(flatter, sheet), Boundedness::attained);
  EXPECT_EQ(bounded(along, none), Boundedness::unbounded);
  EXPECT_EQ(bounded(smaller, none), Boundedness::attained);
  EXPECT_EQ(bounded(against, none), Boundedness::not_attained);
}

}  // namespace
}  // namespace hauberk::test
