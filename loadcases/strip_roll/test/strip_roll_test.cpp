#include "../strip_roll.hpp"

#include "common/test/paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

constexpr std::size_t macros = 2, all = 5;  // exx, k; then along the axis, around it, along the normal

const StripRoll free_strip(false, true);

using Unknowns = std::array<double, all>;

using Draw = test::Path<macros, all>;

Draw draw(std::mt19937_64& rng)
{
  Draw d = Draw::drawn(rng, {2.0, 2.0, 0.6});
  d.T = Vec3(3.0 * d.X.z(), 0.0, 0.0);
  return d;
}

PositionMap position(const LoadCase& load, std::span<const double> y, const Vec3& X, const Vec3& T)
{
  PositionMap map;
  load.position(y.first(macros), y.subspan(macros), X, T, map);
  return map;
}

TEST(StripRoll, RestIsThePlace)
{
  const Vec3 X(1.0, -2.0, 0.3), T(7.0, 0.0, 0.0);
  EXPECT_EQ(position(free_strip, Unknowns{}, X, T).x, X + T);
}

/// Of every size of angle; elements that slide around the axis stay on the cylinder.
TEST(StripRoll, ElementsAreOnTheCylinder)
{
  const double strain = 0.2, x = 0.4, T = 3.0, along = -0.1, s = 1.7, slid = 0.5, z = 0.6;
  for (const double angle : {-5.0, -1e-3, 1e-9, 1e-3, 0.5, 1.999999999, 2.000000001, 3.3, 6.2}) {
    const double k = angle / s;
    const PositionMap map =
        position(free_strip, Unknowns{strain, k, along, slid, z}, {x, s - slid, 0.0}, {T, 0, 0});
    const double half = std::sin(0.5 * angle);  // 1 - cos a = 2 sin^2(a/2) keeps its digits
    const Vec3 exact((1.0 + strain) * (x + T) + along, std::sin(angle) / k - z * std::sin(angle),
                     2.0 * half * half / k + z * std::cos(angle));
    EXPECT_LT((map.x - exact).norm(), 4e-15) << angle;
  }
}

/// What an element's coordinates move it by, on the sheet itself: along the axis, around it, along the
/// normal.
TEST(StripRoll, CoordinatesAreLengthsAlongTheSheet)
{
  std::mt19937_64 rng(1);
  for (int repeat = 0; repeat < 100; ++repeat) {
    Draw d = draw(rng);
    d.y[4] = -d.X.z();
    const Eigen::Matrix3d frame = position(free_strip, d.y, d.X, d.T).J.middleCols<3>(macros);
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_GT(frame.determinant(), 0.0);
  }
}

TEST(StripRoll, DerivativesAreExact)
{
  std::mt19937_64 rng(3);
  for (int repeat = 0; repeat < 50; ++repeat) test::expect_exact_derivatives(free_strip, draw(rng));
}

/// The kernel's broad phase rests on this: an image is displaced by (1 + exx) T, whatever the curvature.
TEST(StripRoll, ImagesAreDisplacedLinearly)
{
  std::mt19937_64 rng(4);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Draw d = draw(rng);
    const Vec3 moved = position(free_strip, d.y, d.X, d.T).x - position(free_strip, d.y, d.X, Vec3::Zero()).x;
    EXPECT_LT((moved - (1.0 + d.y[0]) * d.T).norm(), 1e-14);
  }
}

/// Never exceeded, and reached where a flat strip begins to roll.
TEST(StripRoll, AccelerationIsBounded)
{
  std::mt19937_64 rng(5);
  double tightest = 0.0;
  for (int repeat = 0; repeat < 2000; ++repeat)
    tightest = std::max(tightest, draw(rng).tightness(free_strip));
  EXPECT_LE(tightest, 1.0);
  EXPECT_GT(tightest, 0.7);
  Draw begins;
  begins.X = Vec3(0.0, 2.0, 0.0);
  begins.dy[1] = 0.1;
  EXPECT_LE(begins.tightness(free_strip), 1.0 + 1e-14);
  EXPECT_GT(begins.tightness(free_strip), 1.0 - 1e-14);
}

/// A state of two elements in rows 2 apart.
struct Two {
  std::array<double, macros> macro{};
  std::array<double, 4> e{};
  std::array<Vec3, 2> X{Vec3(0.0, -1.0, 0.0), Vec3(0.0, 1.0, 0.0)};
  std::array<double, 2> radius{1.0, 1.0};
  std::array<std::array<int, 2>, 2> linked{std::array<int, 2>{0, 1}, std::array<int, 2>{0, 0}};
  std::array<Vec3, 2> translations{Vec3::Zero(), Vec3(2.0, 0.0, 0.0)};

  std::string why() const
  {
    return StripRoll(false, false).not_a_sheet({macro, e, X, radius, linked, translations});
  }
};

TEST(StripRoll, SaysWhatNoSheetIs)
{
  Two two;
  EXPECT_EQ(two.why(), "");
  two.macro[1] = 1.999;
  EXPECT_EQ(two.why(), "");
  two.macro[1] = 2.0;
  EXPECT_NE(two.why().find("the radius of the roll is 0.5 times that of element 0"), std::string::npos);
  two.macro[1] = 1.5;
  two.X = {Vec3(0.0, -2.2, 0.0), Vec3(0.0, 2.2, 0.0)};
  EXPECT_NE(two.why().find("the strip goes 1.05 times around"), std::string::npos) << two.why();
  // Along the axis the strain takes linked images apart, which are 2 apart at rest.
  two = Two{};
  two.macro[0] = 1.99;
  EXPECT_EQ(two.why(), "");
  two.macro[0] = 2.0;
  EXPECT_NE(two.why().find("the linked elements 0 and 0 are 3 times"), std::string::npos) << two.why();
  // Around it elements slide apart.
  two = Two{};
  two.e = {0.0, -2.0, 0.0, 2.1};
  EXPECT_NE(two.why().find("the linked elements 0 and 1 are 3.05 times"), std::string::npos) << two.why();
}

}  // namespace
}  // namespace hauberk
