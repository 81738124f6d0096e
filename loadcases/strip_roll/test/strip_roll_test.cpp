#include "../strip_roll.hpp"

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

struct Draw {
  Unknowns y{}, dy{};
  Vec3 X, T;
};

Draw draw(std::mt19937_64& rng)
{
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Draw d;
  for (double& v : d.y) v = u(rng);
  for (double& v : d.dy) v = u(rng);
  d.X = 2.0 * Vec3(u(rng), u(rng), 0.3 * u(rng));
  d.T = Vec3(3.0 * u(rng), 0.0, 0.0);
  return d;
}

PositionMap position(const LoadCase& load, std::span<const double> y, const Vec3& X, const Vec3& T)
{
  PositionMap map;
  load.position(y.first(macros), y.subspan(macros), X, T, map);
  return map;
}

Unknowns along(const Draw& d, double s)
{
  Unknowns y = d.y;
  for (std::size_t k = 0; k < all; ++k) y[k] += s * d.dy[k];
  return y;
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

/// Central differences over h and h/2: the errors of exact derivatives fall by four.
TEST(StripRoll, DerivativesAreExact)
{
  std::mt19937_64 rng(3);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Draw d = draw(rng);
    const PositionMap map = position(free_strip, d.y, d.X, d.T);
    ASSERT_TRUE(map.curved);
    Vec3 slope = Vec3::Zero(), second = Vec3::Zero();
    for (std::size_t i = 0; i < all; ++i) {
      slope += map.J.col(static_cast<Eigen::Index>(i)) * d.dy[i];
      for (std::size_t j = 0; j < all; ++j)
        second += d.dy[i] * d.dy[j] * Vec3(map.H[0][i][j], map.H[1][i][j], map.H[2][i][j]);
    }
    std::array<double, 2> first_error{}, second_error{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = k == 0 ? 4e-3 : 2e-3;
      const Vec3 a = position(free_strip, along(d, h), d.X, d.T).x,
                 b = position(free_strip, along(d, -h), d.X, d.T).x;
      first_error[k] = ((a - b) / (2.0 * h) - slope).norm();
      second_error[k] = ((a - 2.0 * map.x + b) / (h * h) - second).norm();
    }
    EXPECT_LT(first_error[0], 1e-2);
    EXPECT_LT(second_error[0], 1e-2);
    EXPECT_NEAR(first_error[0] / first_error[1], 4.0, 0.05 + 1e-11 / first_error[1]);
    EXPECT_NEAR(second_error[0] / second_error[1], 4.0, 0.05 + 1e-8 / second_error[1]);
  }
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

/// Second differences along paths never pass the bound, and come near to it where a flat strip begins to
/// roll.
TEST(StripRoll, AccelerationIsBounded)
{
  const auto worst = [](const Draw& d) {
    const std::span y(d.y), dy(d.dy);
    const double bound = free_strip.acceleration_bound(y.first(macros), dy.first(macros), y.subspan(macros),
                                                       dy.subspan(macros), d.X, d.T);
    double most = 0.0;
    for (double s = 0.01; s < 1.0; s += 0.02) {
      constexpr double h = 1e-3;
      const Vec3 a = position(free_strip, along(d, s - h), d.X, d.T).x,
                 b = position(free_strip, along(d, s), d.X, d.T).x,
                 c = position(free_strip, along(d, s + h), d.X, d.T).x;
      most = std::max(most, (a - 2.0 * b + c).norm() / (h * h));
    }
    return most / bound;
  };
  std::mt19937_64 rng(5);
  for (int repeat = 0; repeat < 200; ++repeat) EXPECT_LT(worst(draw(rng)), 1.0 + 1e-5);
  Draw flat;
  flat.X = Vec3(0.0, 2.0, 0.0);
  flat.T = Vec3::Zero();
  flat.dy[1] = 1e-2;
  EXPECT_GT(worst(flat), 0.999);
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
