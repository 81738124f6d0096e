#include "../cylinder_roll.hpp"

#include "common/test/paths.hpp"

#include <gtest/gtest.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

constexpr std::size_t macros = 3, all = 6;  // kxx, kyy, kxy; then along x, along y, along the normal

constexpr CylinderRoll::Hold places{true, true, true};

const CylinderRoll free_roll({}, true);

using Unknowns = std::array<double, all>;

using Draw = test::Path<macros, all>;

Draw draw(std::mt19937_64& rng) { return Draw::drawn(rng, {2.0, 2.0, 0.6}); }

PositionMap position(const LoadCase& load, std::span<const double> y, const Vec3& X)
{
  PositionMap map;
  load.position(y.first(macros), y.subspan(macros), X, Vec3::Zero(), map);
  return map;
}

/// kappa n n^T for n = (cos theta, sin theta).
std::array<double, macros> roll(double kappa, double theta)
{
  const double c = std::cos(theta), s = std::sin(theta);
  return {kappa * c * c, kappa * s * s, kappa * c * s};
}

Unknowns at_rest_on(const std::array<double, macros>& K) { return {K[0], K[1], K[2], 0.0, 0.0, 0.0}; }

TEST(CylinderRoll, RestIsThePlace)
{
  const Vec3 X(1.0, -2.0, 0.3);
  EXPECT_EQ(position(free_roll, Unknowns{}, X).x, X);
}

/// Of every size of angle: among them 2, where series and closed forms of the coefficients meet, and more
/// than half a turn to either side.
TEST(CylinderRoll, AlongAnAngleElementsAreOnTheCylinder)
{
  const double theta = 0.4, s = 1.7, t = -2.3, z = 0.6;
  const Vec3 n(std::cos(theta), std::sin(theta), 0.0), m(-n.y(), n.x(), 0.0);
  for (const double angle : {-5.0, -1e-3, 1e-9, 1e-3, 0.5, 1.999999999, 2.000000001, 3.3, 6.2}) {
    const double kappa = angle / s;
    const Vec3 x = position(free_roll, at_rest_on(roll(kappa, theta)), s * n + t * m + Vec3(0, 0, z)).x;
    const Vec3 normal = -std::sin(angle) * n + std::cos(angle) * Vec3::UnitZ();
    const double half = std::sin(0.5 * angle);  // 1 - cos a = 2 sin^2(a/2) keeps its digits
    const Vec3 exact =
        std::sin(angle) / kappa * n + t * m + Vec3(0.0, 0.0, 2.0 * half * half / kappa) + z * normal;
    EXPECT_LT((x - exact).norm(), 4e-15) << angle;
  }
}

/// The sheet's own lengths: tangents along and across stay orthonormal wherever an element slides, and what
/// is off the sheet is along their normal.
TEST(CylinderRoll, ARollKeepsLengthsAlongTheSheet)
{
  std::mt19937_64 rng(1);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Draw d = draw(rng);
    const auto K = roll(2.0 * d.dy[0], 3.0 * d.dy[1]);
    const Unknowns y{K[0], K[1], K[2], d.y[3], d.y[4], 0.0};
    const PositionMap map = position(free_roll, y, {d.X.x(), d.X.y(), 0.0});
    const Eigen::Matrix3d frame = map.J.middleCols<3>(macros);
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_GT(frame.determinant(), 0.0);
  }
}

/// K = kappa I is the sphere of that curvature, walked from its pole: lines through the pole keep lengths.
TEST(CylinderRoll, EqualCurvaturesAreASphere)
{
  std::mt19937_64 rng(2);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Draw d = draw(rng);
    const double kappa = d.dy[0];
    const Vec3 X(d.X.x(), d.X.y(), 0.0), x = position(free_roll, {{kappa, kappa, 0, 0, 0, 0}}, X).x;
    const Vec3 centre(0.0, 0.0, 1.0 / kappa);
    EXPECT_NEAR((x - centre).norm() * std::abs(kappa), 1.0, 1e-13);
    EXPECT_NEAR(x.head<2>().norm(), std::abs(std::sin(kappa * X.norm()) / kappa), 1e-13);
  }
}

TEST(CylinderRoll, DerivativesAreExact)
{
  std::mt19937_64 rng(3);
  for (int repeat = 0; repeat < 50; ++repeat) test::expect_exact_derivatives(free_roll, draw(rng));
}

/// With less freedom positions and derivatives are the same where an element stays.
TEST(CylinderRoll, HeldCoordinatesAreThoseOfZero)
{
  const Vec3 X(1.2, -0.7, 0.2);
  const std::array<double, macros> K{0.5, -0.3, 0.2};
  const PositionMap whole = position(free_roll, at_rest_on(K), X);
  const auto same = [&](const CylinderRoll& load, const std::vector<Eigen::Index>& columns) {
    std::vector<double> y(K.begin(), K.end());
    y.resize(columns.size(), 0.0);
    const PositionMap map = position(load, y, X);
    EXPECT_EQ(map.x, whole.x);
    for (std::size_t a = 0; a < columns.size(); ++a) {
      EXPECT_EQ(map.J.col(a), whole.J.col(columns[a]));
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t b = 0; b < columns.size(); ++b)
          EXPECT_EQ(map.H[i][a][b],
                    whole.H[i][static_cast<std::size_t>(columns[a])][static_cast<std::size_t>(columns[b])]);
    }
  };
  same(CylinderRoll({}, false), {0, 1, 2, 3, 4});
  same(CylinderRoll(places, true), {0, 1, 2, 5});
  same(CylinderRoll(places, false), {0, 1, 2});
}

/// Never exceeded, and reached where a flat sheet begins to roll. On long random paths, whose parts of the
/// acceleration cancel as often as they add, it is 0.38 of the bound in the mean.
TEST(CylinderRoll, AccelerationIsBounded)
{
  std::mt19937_64 rng(4);
  double tightest = 0.0, sum = 0.0;
  constexpr int paths = 2000;
  for (int repeat = 0; repeat < paths; ++repeat) {
    const double ratio = draw(rng).tightness(free_roll);
    tightest = std::max(tightest, ratio);
    sum += ratio;
  }
  EXPECT_LE(tightest, 1.0);
  EXPECT_GT(tightest, 0.7);
  EXPECT_GT(sum / paths, 0.35);
  Draw begins;
  begins.X = Vec3(2.0, 0.0, 0.0);
  begins.dy[0] = 0.1;
  EXPECT_LE(begins.tightness(free_roll), 1.0 + 1e-14);
  EXPECT_GT(begins.tightness(free_roll), 1.0 - 1e-14);
}

/// At the limits of an angle K is kappa n n^T, and the value is kappa.
TEST(CylinderRoll, ConditionsLeaveTheRollAlongTheLoad)
{
  for (const double theta : {0.0, 0.3, std::numbers::pi / 4.0, 2.0}) {
    const Direction direction = Direction::at_radians(theta);
    const auto K = roll(0.7, theta);
    EXPECT_NEAR(free_roll.value(direction, K), 0.7, 1e-15);
    const auto conditions = free_roll.conditions(direction);
    ASSERT_EQ(conditions.size(), 2U);
    Eigen::Matrix3d rows;
    std::array<double, macros> t{};
    free_roll.load(direction, t);
    for (int k = 0; k < 3; ++k) {
      const std::size_t i = k;
      rows.col(k) << t[i], conditions[0].coefficients[i], conditions[1].coefficients[i];
    }
    EXPECT_LT((rows * Eigen::Vector3d(K[0], K[1], K[2]) - Eigen::Vector3d(0.7, 0.0, 0.0)).norm(), 1e-15);
    EXPECT_NEAR(std::abs(rows.determinant()), 1.0, 1e-14) << "something else keeps them";
  }
}

TEST(CylinderRoll, MetricIsFrameIndependent)
{
  std::array<double, macros> m{};
  free_roll.metric(m);
  const auto norm = [&](const Eigen::Matrix2d& K) {
    return m[0] * K(0, 0) * K(0, 0) + m[1] * K(1, 1) * K(1, 1) + m[2] * K(0, 1) * K(0, 1);
  };
  Eigen::Matrix2d K;
  K << 0.3, 0.4, 0.4, -0.2;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  EXPECT_NEAR(norm(R * K * R.transpose()), norm(K), 1e-14);
}

/// What moves the patch moves the roll: turned over, it bends down for up.
TEST(CylinderRoll, TransformsWithTheSheet)
{
  std::mt19937_64 rng(5);
  Mat3 mirror = Mat3::Identity(), over = Mat3::Identity();
  mirror(0, 0) = over(2, 2) = -1.0;
  const Mat3 turn = rotation_exp(Vec3(0.0, 0.0, 0.7));
  for (const Mat3& O : {turn, Mat3(turn * mirror), Mat3(turn * over), Mat3(-turn)}) {
    const Draw d = draw(rng);
    Unknowns y{};
    ASSERT_TRUE(free_roll.transform(O, std::span(d.y).first(macros), std::span(y).first(macros)));
    const Vec3 u = O * Vec3(d.y[3], d.y[4], d.y[5]);
    std::copy(u.begin(), u.end(), y.begin() + macros);
    EXPECT_LT((position(free_roll, y, O * d.X).x - O * position(free_roll, d.y, d.X).x).norm(), 1e-13);
  }
  std::array<double, macros> out{};
  EXPECT_FALSE(free_roll.transform(rotation_exp(Vec3(0.1, 0.0, 0.0)), std::array{1.0, 2.0, 3.0}, out));
}

/// What `load` holds for elements at X: a row per condition, three columns per element.
Eigen::MatrixXd held(const LoadCase& load, std::span<const Vec3> X)
{
  const auto equalities = load.equalities(X);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(equalities.size()),
                                               static_cast<Eigen::Index>(3 * X.size()));
  for (std::size_t k = 0; k < equalities.size(); ++k)
    for (const LinearTerm& t : equalities[k].terms)
      rows(static_cast<Eigen::Index>(k), 3 * t.element + t.coordinate) += t.coefficient;
  return rows;
}

/// The flat sheet can be written as lying on a rolled one: that is what must be held.
TEST(CylinderRoll, NoHeightsMakeUpForACurvature)
{
  std::mt19937_64 rng(6);
  std::vector<Vec3> X;
  for (int i = 0; i < 12; ++i) X.push_back(draw(rng).X);
  const Eigen::MatrixXd rows = held(free_roll, X);
  ASSERT_EQ(rows.rows(), 9);
  EXPECT_LT((rows * rows.transpose() - Eigen::MatrixXd::Identity(9, 9)).norm(), 1e-13);
  const auto violation = [&](const auto& motion) {
    Eigen::VectorXd e(36);
    for (Eigen::Index i = 0; i < 12; ++i) e.segment<3>(3 * i) = motion(X[i]);
    return (rows * e).norm() / e.norm();
  };
  using V = Vec3;
  EXPECT_NEAR(violation([](const V&) { return V(0.6, -0.8, 0.0); }), 1.0, 1e-14);
  EXPECT_NEAR(violation([](const V&) { return V(0.0, 0.0, 1.0); }), 1.0, 1e-14);
  EXPECT_NEAR(violation([](const V& x) { return V(0.0, 0.0, 2.0 * x.x() - x.y()); }), 1.0, 1e-14);
  EXPECT_NEAR(violation([](const V& x) { return V(0.0, 0.0, x.x() * x.x() - 3.0 * x.x() * x.y()); }), 1.0,
              1e-14);
  EXPECT_GT(violation([](const V& x) { return V(-x.y(), x.x(), 0.0); }), 0.99);
  EXPECT_LT(violation([](const V& x) { return V(0.0, 0.0, std::pow(x.x(), 3)); }), 0.99);
}

/// Elements in a line have no curvature across it, and three of them no other freedom.
TEST(CylinderRoll, ConditionsAreIndependentOfElementsInALine)
{
  const std::vector<Vec3> X{{-4, 0, 0}, {-1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(held(free_roll, X).rows(), 3 + 3);
  EXPECT_EQ(held(free_roll, std::span(X).first(2)).rows(), 3 + 2);
  EXPECT_EQ(CylinderRoll({}, false).equalities(X).size(), 3U);
  EXPECT_EQ(CylinderRoll(places, false).equalities(X).size(), 0U);
}

TEST(CylinderRoll, ContainsWhatHasLessFreedom)
{
  const CylinderRoll flat({}, false), placed(places, true), twist({false, true, false}, true),
      transverse({false, false, true}, true);
  EXPECT_TRUE(free_roll.contains(flat) && free_roll.contains(placed) && twist.contains(free_roll) &&
              transverse.contains(flat));
  EXPECT_FALSE(flat.contains(free_roll) || placed.contains(free_roll) || flat.contains(placed) ||
               placed.contains(flat) || free_roll.contains(twist) || twist.contains(transverse));
  EXPECT_EQ(free_roll.stricter().size(), 2U);
  EXPECT_TRUE(CylinderRoll(places, false).stricter().empty());
}

/// Held names are those of conditions, so that a limit along components does not claim them.
TEST(CylinderRoll, NamesWhatItHolds)
{
  const CylinderRoll load(places, false);
  EXPECT_EQ(load.hold(Direction::at_radians(0.3)),
            (std::vector<std::string>{"places", "twist", "transverse"}));
  EXPECT_EQ(load.hold(Direction::along(std::array{1.0, 0.0, 0.0})), (std::vector<std::string>{"places"}));
}

TEST(CylinderRoll, UnitsAndNames)
{
  EXPECT_FALSE(free_roll.periodic());
  EXPECT_EQ(free_roll.value_length_power(), -1);
  EXPECT_EQ(free_roll.measure(), "roll_curvature");
  EXPECT_EQ(free_roll.sense_names(), (std::pair<std::string, std::string>{"up", "down"}));
}

/// Two linked elements 4 apart along x about the apex, of radius 2 and 1.5.
struct Two {
  std::array<Vec3, 2> X{Vec3(-2, 0, 0), Vec3(2, 0, 0)};
  std::array<double, 4> e{};
  std::array<double, 2> radius{2.0, 1.5};
  std::array<std::array<int, 2>, 1> linked{{{0, 1}}};

  std::string why(const std::array<double, macros>& K) const
  {
    return CylinderRoll({}, false).not_a_sheet({K, e, X, radius, linked});
  }
};

TEST(CylinderRoll, NoSheetIsLeftWhereItRollsInHalfARadius)
{
  const Two two;
  for (const double sign : {1.0, -1.0}) {
    for (const double theta : {0.0, 0.9, 2.0}) {
      EXPECT_EQ(two.why(roll(sign * 0.9999, theta)), "");
      EXPECT_EQ(
          two.why(roll(sign * 1.0001, theta)),
          "no sheet on the scale of its elements: the radius of the roll is 0.5 times that of element 0, "
          "which counts above 0.5");
    }
  }
}

/// One turn is 2 pi/kappa along the roll; across it a patch may be as long as it likes.
TEST(CylinderRoll, NoPatchRollsUpMoreThanOnce)
{
  Two two;
  two.linked[0] = {0, 0};
  for (const double turns : {0.9999, 1.0001}) {
    const double apart = 2.0 * std::numbers::pi * turns / 0.9;
    two.X = {Vec3(-1, 0, 0), Vec3(-1 + apart - 0.25, 0, 0)};
    two.e = {-0.125, 0.0, 0.125, 0.0};
    for (const double sign : {1.0, -1.0}) {
      EXPECT_EQ(two.why(roll(sign * 0.9, 0.0)).empty(), turns < 1.0);
      EXPECT_EQ(two.why(roll(sign * 0.9, std::numbers::pi / 2.0)), "");
    }
  }
  EXPECT_EQ(two.why(roll(0.9, 0.0)),
            "no sheet beside itself: the patch goes 1 times around the roll, which counts below 1");
}

TEST(CylinderRoll, NoSheetIsLeftWhereLinkedElementsAreFarApartAlongIt)
{
  Two two;
  two.e = {-3.999, 0.0, 4.0, 0.0};  // 12 is 3 times their distance at rest
  EXPECT_EQ(two.why(roll(0.1, 0.0)), "");
  two.e[0] = -4.001;
  EXPECT_EQ(two.why(roll(0.1, 0.0)),
            "no sheet on the scale of its elements: along the sheet the linked elements 0 and 1 are 3 times "
            "as far apart as at rest or as their mean radius, whichever is longer, which counts below 3");
  two.linked[0] = {0, 0};
  EXPECT_EQ(two.why(roll(0.1, 0.0)), "") << "not linked";
}

}  // namespace
}  // namespace hauberk
