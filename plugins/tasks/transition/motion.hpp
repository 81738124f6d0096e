#pragma once
/// A rigid motion along which contact is watched.

#include "contact/side_terms.hpp"
#include "model/scene.hpp"

namespace hauberk {

/// A rotation about a fixed line together with a translation, both linear in s of [0, 1] (a screw, if the
/// translation is along the axis): with Q = exp(angle(s) axis),
///
///   x(s) = through + Q (x - through) + shift(s),   rotation(s) = Q rotation.
struct RigidMotion {
  Vec3 axis = Vec3::Zero();                 ///< unit; zero: no rotation
  Vec3 through = Vec3::Zero();              ///< a point of the line
  double angle_from = 0.0, angle_to = 0.0;  ///< radians
  Vec3 shift_from = Vec3::Zero(), shift_to = Vec3::Zero();

  double angle(double s) const { return angle_from + s * (angle_to - angle_from); }
  Vec3 shift(double s) const { return shift_from + s * (shift_to - shift_from); }
};

/// Where the motion takes an element that is at `rest` without it.
Pose moved(const RigidMotion& motion, const Pose& rest, double s);

/// (dx/ds, w) of that element's origin at s, w its angular velocity (radians per s).
Vec6 velocity(const RigidMotion& motion, const Pose& rest, double s);

}  // namespace hauberk
