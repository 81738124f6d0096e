#include "../paraboloid_bending.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hauberk {
namespace {

constexpr int macros = 3, all = 5;  // A, B, C; then u_x, u_y

struct Draw {
  std::array<double, all> y{}, dy{};
  Vec3 X;
};

Draw draw(std::mt19937_64& rng)
{
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Draw d;
  for (double& v : d.y) v = u(rng);
  for (double& v : d.dy) v = u(rng);
  d.X = 3.0 * Vec3(u(rng), u(rng), 0.1 * u(rng));
  return d;
}

PositionMap position(const LoadCase& load, const std::array<double, all>& y, const Vec3& X)
{
  PositionMap map;
  load.position(std::span(y).first(macros), std::span(y).subspan(macros), X, Vec3::Zero(), map);
  return map;
}

std::array<double, all> along(const Draw& d, double s)
{
  std::array<double, all> y = d.y;
  for (std::size_t k = 0; k < all; ++k) y[k] += s * d.dy[k];
  return y;
}

TEST(ParaboloidBending, RestIsThePlace)
{
  const ParaboloidBending load({});
  const Vec3 X(1.0, -2.0, 0.3);
  EXPECT_EQ(position(load, {}, X).x, X);
}

TEST(ParaboloidBending, ElementsAreOnTheParaboloid)
{
  const ParaboloidBending load({});
  const Vec3 x = position(load, {0.1, -0.2, 0.3, 0.5, -1.0}, {1.5, 3.0, 0.25}).x;
  EXPECT_NEAR((x - Vec3(2.0, 2.0, 0.25 + 0.4 - 0.8 + 1.2)).norm(), 0.0, 1e-15);
}

/// Central differences over h and h/2: exact derivatives leave errors that fall by four (the map is cubic, so
/// first differences have exactly one error term, and second ones none).
TEST(ParaboloidBending, DerivativesAreExact)
{
  const ParaboloidBending load({});
  std::mt19937_64 rng(1);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Draw d = draw(rng);
    const PositionMap map = position(load, d.y, d.X);
    ASSERT_TRUE(map.curved);
    Vec3 slope = Vec3::Zero();
    for (int k = 0; k < all; ++k) slope += map.J.col(k) * d.dy[k];
    double second = 0.0;
    for (std::size_t i = 0; i < all; ++i)
      for (std::size_t j = 0; j < all; ++j) second += d.dy[i] * map.H[2][i][j] * d.dy[j];
    std::array<double, 2> error{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = k == 0 ? 1e-2 : 5e-3;
      const PositionMap a = position(load, along(d, h), d.X), b = position(load, along(d, -h), d.X);
      error[k] = ((a.x - b.x) / (2.0 * h) - slope).norm();
      EXPECT_NEAR((a.x.z() - 2.0 * map.x.z() + b.x.z()) / (h * h), second, 1e-9);
    }
    EXPECT_LT(error[0], 1e-2);
    EXPECT_NEAR(error[0] / error[1], 4.0, 1e-3 + 1e-11 / error[1]);
    for (std::size_t k = 0; k < 2; ++k)
      for (const auto& row : map.H[k])
        for (const double v : row) EXPECT_EQ(v, 0.0);
  }
}

/// Never below what is sampled, and reached at one of the ends.
TEST(ParaboloidBending, AccelerationIsBoundedTightly)
{
  const ParaboloidBending load({});
  std::mt19937_64 rng(2);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Draw d = draw(rng);
    const std::span y(d.y), dy(d.dy);
    const double bound = load.acceleration_bound(y.first(macros), dy.first(macros), y.subspan(macros),
                                                 dy.subspan(macros), d.X, Vec3::Zero());
    constexpr double h = 0.1;  // z is cubic in s: second differences are exact for any h
    double largest = 0.0;
    for (int k = 0; k <= 20; ++k) {
      const double s = k / 20.0;
      const Vec3 second = position(load, along(d, s + h), d.X).x - 2.0 * position(load, along(d, s), d.X).x +
                          position(load, along(d, s - h), d.X).x;
      largest = std::max(largest, second.norm() / (h * h));
    }
    EXPECT_GE(bound, largest - 1e-8);
    EXPECT_LE(bound, largest + 1e-8);
  }
}

/// The value is the curvature of the section along n at the apex, and the load its derivative.
TEST(ParaboloidBending, ValueIsTheCurvatureOfTheSection)
{
  const ParaboloidBending load({});
  const std::array<double, 3> macro{0.3, -0.1, 0.25};
  for (const double degrees : {0.0, 17.0, 45.0, 90.0, 135.0}) {
    const double theta = degrees * std::numbers::pi / 180.0, h = 1e-3;
    const auto z = [&](double r) {
      return position(load, {macro[0], macro[1], macro[2], 0, 0},
                      {r * std::cos(theta), r * std::sin(theta), 0})
          .x.z();
    };
    const double curvature = (z(h) - 2.0 * z(0.0) + z(-h)) / (h * h);
    EXPECT_NEAR(load.value(Direction::at_radians(theta), macro), curvature, 1e-9);
    std::array<double, 3> t{};
    load.load(Direction::at_radians(theta), t);
    EXPECT_NEAR(t[0] * macro[0] + t[1] * macro[1] + t[2] * macro[2], curvature, 1e-9);
  }
}

/// The norm of macroscopic unknowns does not depend on the frame.
TEST(ParaboloidBending, MetricIsFrameIndependent)
{
  const ParaboloidBending load({});
  std::array<double, 3> m{};
  load.metric(m);
  const auto norm = [&](const Eigen::Matrix2d& Q) {
    const double c = 2.0 * Q(0, 1);
    return m[0] * Q(0, 0) * Q(0, 0) + m[1] * Q(1, 1) * Q(1, 1) + m[2] * c * c;
  };
  Eigen::Matrix2d Q;
  Q << 0.3, 0.4, 0.4, -0.2;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  EXPECT_NEAR(norm(R * Q * R.transpose()), norm(Q), 1e-14);
}

/// Translations and turns, and nothing that keeps the mean and the net turn, violate what is held.
TEST(ParaboloidBending, HoldsTheMeanAndTheTurn)
{
  const ParaboloidBending load({});
  const std::vector<Vec3> X{{1, 0, 0}, {-1, 0.5, 0}, {0, -0.5, 0}};
  const auto equalities = load.equalities(X);
  ASSERT_EQ(equalities.size(), 3U);
  const auto violation = [&](std::size_t k, const std::vector<Eigen::Vector2d>& e) {
    double sum = 0.0;
    for (const LinearTerm& t : equalities[k].terms) sum += t.coefficient * e[t.element][t.coordinate];
    return sum;
  };
  EXPECT_EQ(violation(0, {{1, 0}, {1, 0}, {1, 0}}), 3.0);
  EXPECT_EQ(violation(1, {{0, 1}, {0, 1}, {0, 1}}), 3.0);
  std::vector<Eigen::Vector2d> turned, scaled;
  double spread = 0.0;
  for (const Vec3& x : X) {
    turned.emplace_back(-x.y(), x.x());
    scaled.emplace_back(x.x(), x.y());
    spread += x.squaredNorm();
  }
  EXPECT_NEAR(violation(2, turned), spread, 1e-15);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(violation(k, scaled), 0.0, 1e-15);
}

/// What moves the patch moves the paraboloid: turned over, it bends down for up.
TEST(ParaboloidBending, TransformsWithTheSheet)
{
  const ParaboloidBending load({});
  std::mt19937_64 rng(5);
  Mat3 mirror = Mat3::Identity(), over = Mat3::Identity();
  mirror(0, 0) = over(2, 2) = -1.0;
  const Mat3 turn = rotation_exp(Vec3(0.0, 0.0, 0.7));
  for (const Mat3& O : {turn, Mat3(turn * mirror), Mat3(turn * over), Mat3(-turn)}) {
    const Draw d = draw(rng);
    const std::span<const double> macro = std::span(d.y).first(macros);
    std::array<double, all> y{};
    ASSERT_TRUE(load.transform(O, macro, std::span(y).first(macros)));
    const Vec3 u = O * Vec3(d.y[3], d.y[4], 0.0);
    y[3] = u.x();
    y[4] = u.y();
    EXPECT_LT((position(load, y, O * d.X).x - O * position(load, d.y, d.X).x).norm(), 1e-13);
  }
  std::array<double, macros> out{};
  EXPECT_FALSE(load.transform(rotation_exp(Vec3(0.1, 0.0, 0.0)), std::array{1.0, 2.0, 3.0}, out));
}

TEST(ParaboloidBending, UnitsAndNames)
{
  const ParaboloidBending load({});
  EXPECT_FALSE(load.periodic());
  EXPECT_EQ(load.value_length_power(), -1);
  EXPECT_EQ(load.measure(), "normal_curvature");
  EXPECT_EQ(load.sense_names(), (std::pair<std::string, std::string>{"up", "down"}));
  for (const MacroInfo& macro : load.macros()) EXPECT_EQ(macro.length_power, -1);
}

/// Two linked elements 4 apart along x about the apex, of radius 2 and 1.5.
struct Two {
  std::array<Vec3, 2> X{Vec3(-2, 0, 0), Vec3(2, 0, 0)};
  std::array<double, 4> e{};
  std::array<double, 2> radius{2.0, 1.5};
  std::array<std::array<int, 2>, 1> linked{{{0, 1}}};

  std::string why(const std::array<double, 3>& macro) const
  {
    return ParaboloidBending({}).not_a_sheet({macro, e, X, radius, linked});
  }
};

/// Curvatures turn with the frame: A = k/2 along x is A = B = k/4, C = k/2 along the diagonal.
TEST(ParaboloidBending, NoSheetIsLeftWhereItCurvesTwiceInARadius)
{
  const Two two;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(two.why({0.0, sign * 0.4999, 0.0}), "");
    EXPECT_EQ(two.why({sign * 0.2499, sign * 0.2499, 0.4999}), "");
    for (const std::array<double, 3>& macro :
         {std::array{0.0, sign * 0.5001, 0.0}, {sign * 0.25005, sign * 0.25005, 0.5001}}) {
      EXPECT_EQ(
          two.why(macro),
          "no sheet on the scale of its elements: at the apex the radius of curvature is 0.5 times that "
          "of element 0, which counts above 0.5");
    }
  }
}

TEST(ParaboloidBending, NoSheetIsLeftWhereLinkedElementsAreFarApartAlongIt)
{
  Two two;
  // z = A x^2 between -x and x is x sqrt(1 + s^2) + asinh(s) / (2 A) long, with the slope s = 2 A x.
  const auto length = [](double a, double x) {
    const double s = 2.0 * a * x;
    return x * std::hypot(1.0, s) + std::asinh(s) / (2.0 * a);
  };
  const double a = 0.49;
  double x = 0.0;  // where it is 3 times 4
  for (double step = 4.0; step > 1e-12; step *= 0.5) x += length(a, x + step) < 12.0 ? step : 0.0;
  ASSERT_GT(x, 2.0);
  two.e = {2.0 - (x - 1e-6), 0.0, x - 1e-6 - 2.0, 0.0};
  EXPECT_EQ(two.why({a, 0.0, 0.0}), "");
  two.e = {2.0 - (x + 1e-6), 0.0, x + 1e-6 - 2.0, 0.0};
  EXPECT_EQ(
      two.why({a, 0.0, 0.0}),
      "no sheet on the scale of its elements: along the surface the linked elements 0 and 1 are 3 times "
      "as far apart as at rest or as their mean radius, whichever is longer, which counts below 3");
  two.linked = {};
  two.linked[0] = {0, 0};
  EXPECT_EQ(two.why({a, 0.0, 0.0}), "") << "not linked";
}

/// Two rings about one place have no distance at rest.
TEST(ParaboloidBending, ElementsAboutOnePlaceMayPartByThreeRadii)
{
  Two two;
  two.X = {Vec3::Zero(), Vec3::Zero()};
  two.e = {-2.62, 0.0, 2.62, 0.0};  // 5.24 apart, of the mean radius 1.75
  EXPECT_EQ(two.why({0.0, 0.0, 0.0}), "");
  two.e = {-2.63, 0.0, 2.63, 0.0};
  EXPECT_NE(two.why({0.0, 0.0, 0.0}), "");
}

}  // namespace
}  // namespace hauberk
