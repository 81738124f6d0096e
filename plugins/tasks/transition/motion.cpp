#include "tasks/transition/motion.hpp"

namespace hauberk {
namespace {

/// From the line's point to the turned origin.
Vec3 arm(const RigidMotion& m, const Pose& rest, double s)
{
  return rotation_exp(m.angle(s) * m.axis) * (rest.position - m.through);
}

Vec3 angular_velocity(const RigidMotion& m) { return (m.angle_to - m.angle_from) * m.axis; }

}  // namespace

Pose moved(const RigidMotion& motion, const Pose& rest, double s)
{
  return {motion.through + arm(motion, rest, s) + motion.shift(s),
          rotation_exp(motion.angle(s) * motion.axis) * rest.rotation};
}

Vec6 velocity(const RigidMotion& motion, const Pose& rest, double s)
{
  const Vec3 w = angular_velocity(motion);
  Vec6 v;
  v << w.cross(arm(motion, rest, s)) + (motion.shift_to - motion.shift_from), w;
  return v;
}

}  // namespace hauberk
