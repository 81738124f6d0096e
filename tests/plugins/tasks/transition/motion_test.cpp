/// Rigid motions: end points, and derivatives against differences.

#include "tasks/transition/motion.hpp"

#include <gtest/gtest.h>

namespace hauberk {
namespace {

RigidMotion screw()
{
  RigidMotion m;
  m.axis = Vec3(1, 2, -2) / 3.0;
  m.through = {0.3, -0.2, 0.9};
  m.angle_from = -0.4;
  m.angle_to = 0.7;
  m.shift_from = {0.1, 0.0, 0.2};
  m.shift_to = {-0.3, 0.5, 0.2};
  return m;
}

Pose rest() { return {{1.0, -0.7, 0.4}, rotation_exp({0.3, 1.1, -0.2})}; }

TEST(Motion, TurnsAboutTheLineAndShifts)
{
  RigidMotion m;
  m.axis = {0, 0, 1};
  m.through = {1, 0, 0};
  m.angle_to = 90.0 * degree;
  m.shift_to = {0, 0, 3};
  const Pose p = moved(m, {{2, 0, 0}, Mat3::Identity()}, 1.0);
  EXPECT_LT((p.position - Vec3(1, 1, 3)).norm(), 1e-15);
  EXPECT_LT((p.rotation * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ((moved(m, rest(), 0.0).position - rest().position).norm(), 0.0);
}

TEST(Motion, DerivativesAgreeWithDifferences)
{
  const RigidMotion m = screw();
  const double h = 1e-4, s = 0.37;
  const Pose a = moved(m, rest(), s - h), c = moved(m, rest(), s), b = moved(m, rest(), s + h);
  const Vec6 v = velocity(m, rest(), s);
  EXPECT_LT((v.head<3>() - (b.position - a.position) / (2.0 * h)).norm(), 1e-8);
  const Vec3 w = v.tail<3>();
  EXPECT_LT((skew(w) * c.rotation - (b.rotation - a.rotation) / (2.0 * h)).norm(), 1e-8);
  // A point of the line does not move but for the shift.
  const Vec3 local = rest().rotation.transpose() * (m.through - rest().position);
  EXPECT_LT((b.position + b.rotation * local - m.through - m.shift(s + h)).norm(), 1e-14);
}

}  // namespace
}  // namespace hauberk
