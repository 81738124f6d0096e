#include "../in_plane_periodic.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace hauberk {
namespace {

constexpr InPlanePeriodic::Hold nothing{false, false};
const InPlanePeriodic flat(StrainMeasure::tensor, {}, nothing);
const InPlanePeriodic equation_12(StrainMeasure::equation_12, {}, nothing);
const InPlanePeriodic layer(StrainMeasure::tensor, {false, 0.3}, nothing);
const InPlanePeriodic spatial(StrainMeasure::tensor, {true, 0.0}, nothing);
const InPlanePeriodic axial(StrainMeasure::tensor, {}, {true, false});
const InPlanePeriodic clamped(StrainMeasure::tensor, {}, {true, true});
const InPlanePeriodic sliding(StrainMeasure::tensor, {}, {false, true});

const std::vector<double> strain = {0.21, -0.13, 0.17};

Mat3 deformation(const std::vector<double>& m)
{
  Mat3 F = Mat3::Identity();
  F(0, 0) += m[0];
  F(1, 1) += m[1];
  F(0, 1) += m[2];
  F(1, 0) += m[2];
  return F;
}

TEST(InPlanePeriodic, Unknowns)
{
  ASSERT_EQ(flat.macro_count(), 3);
  EXPECT_EQ(flat.macros()[0].name, "exx");
  EXPECT_EQ(flat.macros()[1].name, "eyy");
  EXPECT_EQ(flat.macros()[2].name, "exy");
  for (const MacroInfo& macro : flat.macros()) EXPECT_EQ(macro.length_power, 0);
  EXPECT_EQ(flat.coordinate_count(), 2);
  EXPECT_EQ(layer.coordinate_count(), 3);
  EXPECT_EQ(spatial.coordinate_count(), 3);
  EXPECT_TRUE(flat.periodic());
  EXPECT_EQ(flat.value_length_power(), 0);
  EXPECT_EQ(flat.sense_names(), (std::pair<std::string, std::string>("stretch", "compress")));
  EXPECT_EQ(flat.measure(), "tensor");
  EXPECT_EQ(equation_12.measure(), "equation_12");
  double metric[3];
  flat.metric(metric);
  EXPECT_EQ(metric[0], 1.0);
  EXPECT_EQ(metric[1], 1.0);
  EXPECT_EQ(metric[2], 2.0);
}

TEST(InPlanePeriodic, RestIsRest)
{
  const Vec3 X(1.5, -2.5, 0.75);
  const Vec3 T(3, 4, 0);
  PositionMap map;
  flat.position(std::vector<double>(3, 0.0), std::vector<double>(2, 0.0), X, T, map);
  EXPECT_EQ(map.x, Vec3(4.5, 1.5, 0.75));
}

TEST(InPlanePeriodic, PositionIsDeformedRestPlusDisplacement)
{
  const Vec3 X(1.5, -2.5, 0.75);
  const Vec3 T(3, 4, 0);
  PositionMap map;
  spatial.position(strain, std::vector<double>{0.1, 0.2, 0.3}, X, T, map);
  EXPECT_NEAR((map.x - (deformation(strain) * (X + T) + Vec3(0.1, 0.2, 0.3))).norm(), 0.0, 1e-15);
  flat.position(strain, std::vector<double>{0.1, 0.2}, X, T, map);
  EXPECT_NEAR((map.x - (deformation(strain) * (X + T) + Vec3(0.1, 0.2, 0))).norm(), 0.0, 1e-15);
  EXPECT_EQ(map.x.z(), 0.75);
}

TEST(InPlanePeriodic, DerivativeOfPositionIsExact)
{
  // Affine in the unknowns, so differences over any step are exact up to rounding.
  const Vec3 X(1.5, -2.5, 0.75);
  const Vec3 T(3, 4, 0);
  for (const InPlanePeriodic* load_case : {&flat, &layer, &spatial}) {
    std::vector<double> q = strain;
    for (int k = 0; k < load_case->coordinate_count(); ++k) q.push_back(0.1 * (k + 1));
    const auto at = [&](const std::vector<double>& y) {
      PositionMap map;
      map.J.setConstant(7.0);  // what was there before must not survive
      map.curved = true;
      const std::span<const double> all(y);
      load_case->position(all.first(3), all.subspan(3), X, T, map);
      return map;
    };
    const PositionMap base = at(q);
    EXPECT_FALSE(base.curved);
    for (std::size_t k = 0; k < q.size(); ++k) {
      std::vector<double> y = q;
      y[k] += 0.5;
      const Vec3 difference = (at(y).x - base.x) / 0.5;
      EXPECT_NEAR((base.J.col(k) - difference).norm(), 0.0, 1e-14) << k;
      EXPECT_GT(difference.norm(), 0.9);
    }
    for (auto k = static_cast<Eigen::Index>(q.size()); k < PositionMap::n; ++k) {
      EXPECT_EQ(base.J.col(k).norm(), 0.0);
    }
  }
  EXPECT_EQ(flat.acceleration_bound(strain, strain, strain, strain, X, T), 0.0);
}

TEST(InPlanePeriodic, WrongSizesAreRefused)
{
  PositionMap map;
  EXPECT_THROW(flat.position(strain, strain, Vec3::Zero(), Vec3::Zero(), map), PluginError);
  EXPECT_THROW(flat.position(std::vector<double>(2), std::vector<double>(2), Vec3::Zero(), Vec3::Zero(), map),
               PluginError);
  EXPECT_THROW(flat.position(std::vector<double>{std::nan(""), 0, 0}, std::vector<double>(2), Vec3::Ones(),
                             Vec3::Zero(), map),
               PluginError);
}

TEST(InPlanePeriodic, AdmissibleMeansPositiveDefinite)
{
  EXPECT_TRUE(flat.admissible(strain));
  EXPECT_TRUE(flat.admissible(std::vector<double>{3.0, -0.75, 0.99}));  // det = 1 - 0.9801
  EXPECT_FALSE(flat.admissible(std::vector<double>{3.0, -0.75, 1.01}));
  EXPECT_FALSE(flat.admissible(std::vector<double>{-1.0, 0.0, 0.0}));
  EXPECT_FALSE(flat.admissible(std::vector<double>{-2.0, -2.0, 0.0}));  // det > 0 but negative definite
  EXPECT_FALSE(flat.admissible(std::vector<double>{std::nan(""), 0.0, 0.0}));
}

TEST(InPlanePeriodic, StretchRangeHoldsTheEigenvalues)
{
  for (const auto& m : {strain, std::vector<double>{0, 0, 0}, std::vector<double>{999, -0.999, 0.5}}) {
    const auto [smallest, largest] = flat.stretch_range(m);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(deformation(m).topLeftCorner<2, 2>());
    EXPECT_NEAR(smallest, solver.eigenvalues()[0], 1e-12);
    EXPECT_NEAR(largest, solver.eigenvalues()[1], 1e-12 * largest);
  }
}

TEST(InPlanePeriodic, TensorValue)
{
  for (const double theta : {0.0, 0.3, 1.2, 2.5}) {
    const Vec3 n(std::cos(theta), std::sin(theta), 0);
    EXPECT_NEAR(flat.value(Direction::at_radians(theta), strain), n.dot(deformation(strain) * n) - 1.0,
                1e-15);
    EXPECT_NEAR(flat.value(Direction::at_radians(theta), strain),
                flat.value(Direction::at_radians(theta + std::numbers::pi), strain), 1e-15);
  }
}

TEST(InPlanePeriodic, PaperValueIsTheLeastSquaresMultiple)
{
  for (const double theta : {0.0, 0.3, 1.2, 2.5}) {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    const Vec3 d(c * c, s * s, c * s);
    EXPECT_NEAR(equation_12.value(Direction::at_radians(theta), strain),
                d.dot(Vec3(strain.data())) / d.squaredNorm(), 1e-15);
    // The published strain of size e along theta is e d: its value is e.
    const Vec3 e = 0.37 * d;
    EXPECT_NEAR(equation_12.value(Direction::at_radians(theta), std::span<const double>(e.data(), 3)), 0.37,
                1e-15);
  }
}

TEST(InPlanePeriodic, LoadIsTheDerivativeOfTheValue)
{
  for (const InPlanePeriodic* load_case : {&flat, &equation_12}) {
    for (const double theta : {0.0, 0.4, 1.5, 2.9}) {
      double t[3];
      load_case->load(Direction::at_radians(theta), t);
      double norm = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> m = strain;
        m[k] += 0.25;
        EXPECT_NEAR(t[k],
                    (load_case->value(Direction::at_radians(theta), m) -
                     load_case->value(Direction::at_radians(theta), strain)) /
                        0.25,
                    1e-14);
        norm += t[k] * t[k];
      }
      EXPECT_GT(norm, 0.9);
    }
  }
}

TEST(InPlanePeriodic, LineStretch)
{
  const double theta = 0.7;
  const Vec3 n(std::cos(theta), std::sin(theta), 0);
  const auto companions = flat.companions(Direction::at_radians(theta), strain);
  ASSERT_EQ(companions.size(), 1U);
  EXPECT_EQ(companions[0].first, "line_stretch");
  EXPECT_NEAR(companions[0].second, (deformation(strain) * n).norm() - 1.0, 1e-15);
  // No digits are lost for small strains.
  const std::vector<double> tiny = {1e-14, 0.0, 0.0};
  EXPECT_NEAR(flat.companions(Direction::at_radians(0.0), tiny)[0].second, 1e-14, 1e-28);
}

TEST(InPlanePeriodic, TransformsWithTheSheet)
{
  Mat3 mirror = Mat3::Identity(), over = Mat3::Identity();
  mirror(0, 0) = over(2, 2) = -1.0;
  const Mat3 turn = rotation_exp(Vec3(0.0, 0.0, 0.7));
  const Vec3 X(1.5, -2.5, 0.75), T(3, 4, 0);
  std::vector<double> out(3);
  for (const Mat3& O : {turn, Mat3(turn * mirror), Mat3(turn * over), Mat3(-turn)}) {
    ASSERT_TRUE(flat.transform(O, strain, out));
    PositionMap before, after;
    flat.position(strain, std::vector<double>(2, 0.0), X, T, before);
    flat.position(out, std::vector<double>(2, 0.0), O * X, O * T, after);
    EXPECT_LT((after.x - O * before.x).norm(), 1e-14);
  }
  EXPECT_FALSE(flat.transform(rotation_exp(Vec3(0.1, 0.0, 0.0)), strain, out));
  EXPECT_TRUE(flat.transform(Mat3::Identity(), strain, out));
  EXPECT_EQ(out, strain);
  EXPECT_THROW(flat.transform(turn, std::vector<double>(2, 0.0), out), PluginError);
}

TEST(InPlanePeriodic, WallsKeepElementsWithinTheHalfHeight)
{
  const std::vector<Vec3> X = {Vec3(0, 0, 5), Vec3(1, 0, 0), Vec3(0, 1, -2)};
  EXPECT_TRUE(flat.inequalities(X).empty());
  EXPECT_TRUE(spatial.inequalities(X).empty());
  EXPECT_TRUE(layer.inequalities(std::span<const Vec3>(X).first(1)).empty());
  const auto walls = layer.inequalities(X);
  ASSERT_EQ(walls.size(), 6U);
  const std::vector<double> u = {0.5, -0.1, 0.35};  // mean 0.25
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::size_t side : {0U, 1U}) {
      const LinearInequality& wall = walls[2 * i + side];
      EXPECT_EQ(wall.name, side == 0 ? "upper" : "lower");
      EXPECT_EQ(wall.terms[0].element, static_cast<int>(i));
      double value = wall.offset;
      double sum = 0.0;
      for (const auto& term : wall.terms) {
        EXPECT_EQ(term.coordinate, 2);
        value += term.coefficient * u[term.element];
        sum += term.coefficient;
      }
      EXPECT_NEAR(value, 0.3 - (side == 0 ? 1.0 : -1.0) * (u[i] - 0.25), 1e-15);
      EXPECT_NEAR(sum, 0.0, 1e-15);  // moving all together meets no wall
    }
  }
}

Boundedness bounded(const InPlanePeriodic& load_case, double deg, Sense sense, std::vector<Vec3> cycles)
{
  return load_case.boundedness(Direction::at_degrees(deg), sense, cycles);
}

TEST(InPlanePeriodic, BoundedWhereCyclesSpanThePlane)
{
  const std::vector<Vec3> square = {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(5, 1, 0)};
  for (const InPlanePeriodic* load_case : {&flat, &equation_12}) {
    for (const double deg : {0.0, 30.0, 90.0}) {
      for (const Sense sense : {Sense::positive, Sense::negative}) {
        EXPECT_EQ(bounded(*load_case, deg, sense, square), Boundedness::attained);
      }
    }
  }
}

TEST(InPlanePeriodic, ChainsBoundStretchOnlyAlongThemselves)
{
  const Vec3 T = 12.0 * Vec3(std::cos(30 * degree), std::sin(30 * degree), 0);
  // Twice the same direction, a closed cycle, and one that is zero up to rounding do not span anything.
  const std::vector<Vec3> chain = {T, -2 * T, Vec3::Zero(), Vec3(-1e-16, 1e-16, 0)};
  EXPECT_EQ(bounded(flat, 30, Sense::positive, chain), Boundedness::attained);
  EXPECT_EQ(bounded(flat, 210, Sense::positive, chain), Boundedness::attained);
  EXPECT_EQ(bounded(flat, 31, Sense::positive, chain), Boundedness::unbounded);
  EXPECT_EQ(bounded(flat, 120, Sense::positive, chain), Boundedness::unbounded);
  // Across itself a sheet of chains is pressed together; along itself it turns aside while it spreads.
  EXPECT_EQ(bounded(flat, 30, Sense::negative, chain), Boundedness::not_attained);
  EXPECT_EQ(bounded(flat, 31, Sense::negative, chain), Boundedness::attained);
  EXPECT_EQ(bounded(flat, 120, Sense::negative, chain), Boundedness::attained);
}

TEST(InPlanePeriodic, ObliqueChainsInThePaperMeasure)
{
  // Equation (12) read literally counts the strain across an oblique chain, so spreading raises it.
  const std::vector<Vec3> oblique = {Vec3(1, 1, 0)};
  EXPECT_EQ(bounded(equation_12, 45, Sense::positive, oblique), Boundedness::unbounded);
  EXPECT_EQ(bounded(equation_12, 45, Sense::negative, oblique), Boundedness::attained);
  EXPECT_EQ(bounded(equation_12, 90, Sense::positive, {Vec3(0, 6, 0)}), Boundedness::attained);
  EXPECT_EQ(bounded(equation_12, 90, Sense::negative, {Vec3(0, 6, 0)}), Boundedness::not_attained);
}

TEST(InPlanePeriodic, NothingLinkedIsUnbounded)
{
  for (const double deg : {0.0, 30.0, 90.0}) {
    EXPECT_EQ(bounded(flat, deg, Sense::positive, {}), Boundedness::unbounded);
    EXPECT_EQ(bounded(flat, deg, Sense::negative, {}), Boundedness::not_attained);
    EXPECT_EQ(bounded(equation_12, deg, Sense::positive, {Vec3::Zero()}), Boundedness::unbounded);
  }
}

TEST(InPlanePeriodic, NotAttainedChainTendsToItsInfimum)
{
  // The path behind `not_attained`: the chain vector F t keeps its length, turns away from t, and F stays
  // positive definite with a determinant that does not vanish, while the value tends to -1.
  double previous = 1.0;
  for (const double phi : {0.5, 1.0, 1.4, 1.5, 1.57}) {
    const double p = std::cos(phi);
    const double q = std::sin(phi);
    const std::vector<double> m = {p - 1.0, (1.0 + q * q) / p - 1.0, q};
    EXPECT_TRUE(flat.admissible(m));
    EXPECT_NEAR((deformation(m) * Vec3::UnitX()).norm(), 1.0, 1e-14);
    EXPECT_NEAR(deformation(m).determinant(), 1.0, 1e-9);
    EXPECT_LT(flat.value(Direction::at_radians(0.0), m), previous);
    previous = flat.value(Direction::at_radians(0.0), m);
  }
  EXPECT_LT(previous, -0.999);
}

/// Of a load on (exx, eyy, exy).
Boundedness bounded(std::array<double, 3> load, const std::vector<Vec3>& cycles)
{
  return flat.boundedness(load, cycles);
}

TEST(InPlanePeriodic, AnyLoadIsBoundedWhereCyclesSpan)
{
  const std::vector<Vec3> square = {Vec3(1, 0, 0), Vec3(0, 1, 0)};
  for (const auto& load : {std::array{1.0, 1.0, 0.0}, std::array{-1.0, 2.0, 0.5}, std::array{0.0, 0.0, 1.0}})
    EXPECT_EQ(bounded(load, square), Boundedness::attained);
}

TEST(InPlanePeriodic, LoadsOnChains)
{
  const std::vector<Vec3> chain = {Vec3(2, 0, 0)};  // along x, so that eyy is free to grow
  EXPECT_EQ(bounded({1, 1, 0}, chain), Boundedness::unbounded);
  EXPECT_EQ(bounded({-1, 1, 0}, chain), Boundedness::unbounded);
  EXPECT_EQ(bounded({1, -1, 0}, chain), Boundedness::attained);
  EXPECT_EQ(bounded({-1, -1, 0}, chain), Boundedness::attained) << "rows pressed together";
  EXPECT_EQ(bounded({-1, -1e-6, 5}, chain), Boundedness::attained);
  EXPECT_EQ(bounded({1, 0, 0}, chain), Boundedness::attained);
  EXPECT_EQ(bounded({1, 0, 2}, chain), Boundedness::attained) << "the chain turns by 45 degrees";
  EXPECT_EQ(bounded({1, 0, -2}, chain), Boundedness::attained);
  EXPECT_EQ(bounded({0, 0, 1}, chain), Boundedness::not_attained);
  EXPECT_EQ(bounded({-1, 0, 3}, chain), Boundedness::not_attained);
  EXPECT_EQ(bounded({-1, 0, 0}, chain), Boundedness::not_attained);
}

TEST(InPlanePeriodic, LoadsOnNothingLinked)
{
  EXPECT_EQ(bounded({1, 1, 0}, {}), Boundedness::unbounded);
  EXPECT_EQ(bounded({1, -5, 0}, {}), Boundedness::unbounded);
  EXPECT_EQ(bounded({0, 0, 1}, {}), Boundedness::unbounded);
  EXPECT_EQ(bounded({-1, -1, 0}, {}), Boundedness::attained);
  EXPECT_EQ(bounded({-1, -1, 1.9}, {}), Boundedness::attained);
  EXPECT_EQ(bounded({-1, -1, 2}, {}), Boundedness::not_attained) << "a line: singular";
  EXPECT_EQ(bounded({-1, -1, 2.1}, {}), Boundedness::unbounded);
}

/// What is decided does not depend on the frame, nor on the size of the load.
TEST(InPlanePeriodic, LoadsOnChainsTurnWithTheFrame)
{
  for (const double deg : {17.0, 90.0, 133.0}) {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(deg * degree).toRotationMatrix();
    const Vec3 T(12.0 * R(0, 0), 12.0 * R(1, 0), 0.0);
    for (const auto& load :
         {std::array{1.0, 0.0, 0.0}, std::array{0.0, 0.0, 1.0}, std::array{1.0, 0.0, 2.0},
          std::array{-1.0, 0.0, 3.0}, std::array{-1.0, 1e-7, 0.0}, std::array{1.0, -1e-7, 0.3},
          std::array{-1.0, 0.0, 0.0}, std::array{-2.0, -1.0, 1.0}}) {
      Eigen::Matrix2d M;
      M << load[0], 0.5 * load[2], 0.5 * load[2], load[1];
      M = 1e-3 * R * M * R.transpose();
      EXPECT_EQ(bounded({M(0, 0), M(1, 1), 2.0 * M(0, 1)}, {T}), bounded(load, {Vec3::UnitX()}))
          << deg << ": " << load[0] << ' ' << load[1] << ' ' << load[2];
    }
  }
}

/// The paths behind the answers for a load M with M_aa = 0 on chains along x of length 1: the value is
/// M_tt p + 2 M_ta q with (p, q) = F t. Turned chains with rows far apart are admissible, and along them the
/// values tend to 2 |M_ta| without reaching it where M_tt <= 0, and have an inner maximum |(M_tt, 2 M_ta)|
/// where M_tt > 0.
TEST(InPlanePeriodic, ChainsTurnTowardsTheirBestState)
{
  const auto turned = [](double phi) {
    const double p = std::cos(phi);
    const double q = std::sin(phi);
    return std::array{p - 1.0, (2.0 + q * q) / p - 1.0, q};
  };
  const auto value = [&turned](const std::array<double, 3>& load, double phi) {
    const std::array<double, 3> m = turned(phi);
    EXPECT_TRUE(flat.admissible(m));
    EXPECT_NEAR((deformation({m[0], m[1], m[2]}) * Vec3::UnitX()).norm(), 1.0, 1e-14);
    EXPECT_GT(deformation({m[0], m[1], m[2]}).determinant(), 1.9);
    return load[0] * (m[0] + 1.0) + load[1] * m[1] + load[2] * m[2];
  };
  double previous = -2.0;
  for (const double phi : {0.5, 1.0, 1.4, 1.5, 1.57, 1.5707}) {
    const double v = value({-1.0, 0.0, 3.0}, phi);
    EXPECT_GT(v, previous);
    EXPECT_LT(v, 3.0);
    previous = v;
  }
  EXPECT_GT(previous, 2.999);
  const double best = value({1.0, 0.0, 2.0}, std::atan2(2.0, 1.0));
  EXPECT_NEAR(best, std::sqrt(5.0), 1e-14);
  for (const double phi : {0.0, 0.9, 1.2, 1.57}) EXPECT_LT(value({1.0, 0.0, 2.0}, phi), best);
}

/// Conditions are zero for strains with principal axes along the load, and are what they are called.
TEST(InPlanePeriodic, ConditionsAreTheStrainsThatTheyName)
{
  const double theta = 0.4;
  const Eigen::Vector2d n(std::cos(theta), std::sin(theta));
  const Eigen::Vector2d m(-n.y(), n.x());
  Eigen::Matrix2d eps;
  eps << strain[0], strain[2], strain[2], strain[1];
  const auto component = [](const MacroCondition& c) {
    return c.coefficients[0] * strain[0] + c.coefficients[1] * strain[1] + c.coefficients[2] * strain[2];
  };
  const auto both = clamped.conditions(Direction::at_radians(theta));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].name, "shear");
  EXPECT_EQ(both[1].name, "lateral");
  EXPECT_NEAR(component(both[0]), n.dot(eps * m), 1e-16);
  EXPECT_NEAR(component(both[1]), m.dot(eps * m), 1e-16);
  EXPECT_EQ(axial.conditions(Direction::at_radians(theta)).size(), 1U);
  EXPECT_TRUE(clamped.conditions(Direction::along(strain)).empty()) << "components hold nothing";
  EXPECT_TRUE(clamped.hold(Direction::along(strain)).empty());
}

/// What links prove depends on what is held; p and q are the parts of a cycle along and across the load.
TEST(InPlanePeriodic, BoundednessOfHeldLoads)
{
  const Vec3 x(12, 0, 0);
  const Vec3 y(0, 6, 0);
  const Vec3 oblique(12, 6, 0);
  const auto stretch = [](const InPlanePeriodic& load, const std::vector<Vec3>& cycles) {
    return load.boundedness(Direction(), Sense::positive, cycles);
  };
  const auto compress = [](const InPlanePeriodic& load, const std::vector<Vec3>& cycles) {
    return load.boundedness(Direction(), Sense::negative, cycles);
  };
  for (const InPlanePeriodic* load : {&axial, &clamped, &sliding}) {
    EXPECT_EQ(stretch(*load, {x, y}), Boundedness::attained);
    EXPECT_EQ(compress(*load, {x, y}), Boundedness::attained);
    EXPECT_EQ(stretch(*load, {x}), Boundedness::attained);
    EXPECT_EQ(stretch(*load, {y}), Boundedness::unbounded) << "rows part";
    EXPECT_EQ(stretch(*load, {}), Boundedness::unbounded);
    EXPECT_EQ(compress(*load, {y}), Boundedness::attained);
  }
  EXPECT_EQ(stretch(axial, {oblique}), Boundedness::attained);
  EXPECT_EQ(compress(axial, {oblique}), Boundedness::attained);
  EXPECT_EQ(stretch(flat, {oblique}), Boundedness::unbounded) << "free shear lets the chain turn";
  // Rows of chains along the load move apart for ever and let them shorten; a sheet that keeps its width does
  // not.
  EXPECT_EQ(compress(axial, {x}), Boundedness::not_attained);
  EXPECT_EQ(compress(axial, {}), Boundedness::not_attained);
  EXPECT_EQ(compress(clamped, {x}), Boundedness::attained);
  EXPECT_EQ(compress(sliding, {}), Boundedness::attained);
}

TEST(InPlanePeriodic, SettingsAreRead)
{
  std::vector<Field> fields;
  in_plane_periodic_fields(fields);
  ASSERT_EQ(fields.size(), 3U);
  EXPECT_EQ(fields[0].default_json, "\"tensor\"");
  EXPECT_EQ(fields[1].default_json, "[\"shear\"]");
  EXPECT_EQ(fields[2].default_json, "0");
  const auto make = [](const char* measure, Node height, const std::vector<std::string>& held = {}) {
    Node section;
    section.type = Node::Type::object;
    Node text;
    text.type = Node::Type::string;
    text.string = measure;
    Node hold;
    hold.type = Node::Type::array;
    for (const std::string& name : held) {
      hold.items.emplace_back();
      hold.items.back().type = Node::Type::string;
      hold.items.back().string = name;
    }
    section.members = {{"measure", text}, {"hold", hold}, {"out_of_plane", std::move(height)}};
    Problems problems;
    return make_in_plane_periodic(section, 5.0, problems);
  };
  Node number;
  number.type = Node::Type::number;
  Node text;
  text.type = Node::Type::string;
  text.string = "free";
  EXPECT_EQ(make("tensor", number)->coordinate_count(), 2);
  EXPECT_EQ(make("equation_12", text)->measure(), "equation_12");
  EXPECT_EQ(make("equation_12", text)->coordinate_count(), 3);
  EXPECT_TRUE(make("tensor", number)->hold(Direction()).empty());
  EXPECT_EQ(make("tensor", number, {"lateral"})->hold(Direction()), std::vector<std::string>{"lateral"});
  number.number = 2.0;
  const std::vector<Vec3> X(2, Vec3::Zero());
  const auto walls = make("tensor", number)->inequalities(X);
  ASSERT_EQ(walls.size(), 4U);
  EXPECT_EQ(walls[0].offset, 0.4);  // 2 in file units over L = 5
}

}  // namespace
}  // namespace hauberk
