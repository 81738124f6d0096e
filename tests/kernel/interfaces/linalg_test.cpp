#include "differences.hpp"

#include <hauberk/linalg.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

Vec3 random_vector(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

double not_a_rotation(const Mat3& Q)
{
  return (Q * Q.transpose() - Mat3::Identity()).norm() + std::abs(Q.determinant() - 1.0);
}

TEST(Linalg, SkewIsTheCrossProduct)
{
  std::mt19937 random(1);
  const Vec3 a = random_vector(random);
  const Vec3 b = random_vector(random);
  EXPECT_NEAR((skew(a) * b - a.cross(b)).norm(), 0.0, 1e-15);
}

TEST(Linalg, RotationExpIsTheAxisAngleRotation)
{
  std::mt19937 random(2);
  EXPECT_EQ(rotation_exp(Vec3::Zero()), Mat3(Mat3::Identity()));
  for (const double angle : {1e-300, 1e-12, 1e-5, 0.1, 1.0, 3.0, std::numbers::pi, 7.0}) {
    const Vec3 axis = random_vector(random).normalized();
    const Mat3 Q = rotation_exp(angle * axis);
    EXPECT_LT((Q - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(), 5e-15) << angle;
    EXPECT_LT(not_a_rotation(Q), 5e-15) << angle;
  }
}

TEST(Linalg, RotationExpKeepsDigitsOfSmallAngles)
{
  // Off-diagonal terms are w to first order, whatever its size.
  const Vec3 w(1e-20, -2e-20, 3e-20);
  const Mat3 Q = rotation_exp(w);
  EXPECT_DOUBLE_EQ(Q(2, 1), w.x());
  EXPECT_DOUBLE_EQ(Q(0, 2), w.y());
  EXPECT_DOUBLE_EQ(Q(1, 0), w.z());
}

TEST(Linalg, RotationExpJacobianIsItsDerivative)
{
  std::mt19937 random(4);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.49, 0.51, 2.0, 3.1, 6.0}) {
    const Vec3 w = angle * random_vector(random).normalized(), dw = random_vector(random);
    const Mat3 claimed = skew(rotation_exp_jacobian(w) * dw) * rotation_exp(w);
    std::array<double, 3> error{};
    for (int j = 0; j < 3; ++j) {
      const double h = 0.02 / (1 << j);
      error[j] = ((rotation_exp(w + h * dw) - rotation_exp(w - h * dw)) / (2.0 * h) - claimed).norm();
    }
    test::expect_second_order(error, 1.0, 1e-12);
  }
  // Its series and its closed form meet.
  const Vec3 axis = random_vector(random).normalized();
  const Mat3 below = rotation_exp_jacobian(std::nextafter(0.5, 0.0) * axis);
  EXPECT_LT((below - rotation_exp_jacobian(0.5 * axis)).norm(), 1e-15);
}

TEST(Linalg, RotationLogIsTheShortestWay)
{
  std::mt19937 random(5);
  constexpr double pi = std::numbers::pi;
  EXPECT_EQ(rotation_log(Mat3::Identity()), Vec3(Vec3::Zero()));
  for (const double angle : {1e-20, 1e-9, 0.1, 1.5, 3.0, pi - 1e-6, pi - 1e-12}) {
    for (int k = 0; k < 20; ++k) {
      const Vec3 w = angle * random_vector(random).normalized();
      EXPECT_LT((rotation_log(rotation_exp(w)) - w).norm(), 2e-15 * std::max(1.0, angle)) << angle;
    }
  }
  for (int k = 0; k < 20; ++k) {
    const Mat3 half = rotation_exp(pi * random_vector(random).normalized());
    const Vec3 w = rotation_log(half);
    EXPECT_NEAR(w.norm(), pi, 1e-15);
    EXPECT_LT((rotation_exp(w) - half).norm(), 2e-15);
  }
  const Vec3 beyond = rotation_log(rotation_exp({0.0, 0.0, 4.0}));
  EXPECT_LT((beyond - Vec3(0.0, 0.0, 4.0 - 2.0 * pi)).norm(), 2e-15);
  EXPECT_LT((rotation_log(rotation_exp({1e-20, 0, 0})) - Vec3(1e-20, 0, 0)).norm(), 1e-35);
}

TEST(Linalg, RotationFromZReachesTheAxisByTheShortestWay)
{
  std::mt19937 random(3);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 axis = random_vector(random).normalized();
    const Mat3 Q = rotation_from_z(axis);
    EXPECT_LT((Q.col(2) - axis).norm(), 1e-15);
    EXPECT_LT(not_a_rotation(Q), 1e-14);
    // Shortest: its axis is perpendicular to z, so the trace is 1 + 2 cos(angle) with cos(angle) = z.
    EXPECT_NEAR(Q.trace(), 1.0 + 2.0 * axis.z(), 1e-14);
  }
}

TEST(Linalg, RotationFromZIsAccurateNextToBothPoles)
{
  EXPECT_EQ(rotation_from_z(Vec3::UnitZ()), Mat3(Mat3::Identity()));
  EXPECT_EQ(rotation_from_z(-Vec3::UnitZ()), Mat3(Vec3(1, -1, -1).asDiagonal()));
  for (const double z : {1.0, -1.0}) {
    for (const double tilt : {1e-3, 1e-6, 1e-9, 1e-12, 1e-100}) {
      const Vec3 axis(0.6 * std::sin(tilt), 0.8 * std::sin(tilt), z * std::cos(tilt));
      const Mat3 Q = rotation_from_z(axis);
      EXPECT_LT(not_a_rotation(Q), 1e-14) << z << " " << tilt;
      EXPECT_LT((Q.col(2) - axis).norm(), 1e-15) << z << " " << tilt;
    }
  }
}

}  // namespace
}  // namespace hauberk
