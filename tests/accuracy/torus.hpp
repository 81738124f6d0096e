#pragma once
/// Tori and distances to them, written for the tests alone: nothing here calls the kernel's distances.

#include "geometry/body.hpp"

namespace hauberk::brute {

/// A torus with elliptical tube, placed in the world: r0 in the ring's plane, r1 along its axis.
struct Torus {
  Vec3 center = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
  double R = 1.0, r0 = 0.1, r1 = 0.1;

  bool round() const { return r0 == r1; }
  double bound() const { return R + std::max(r0, r1); }
  /// Surface point at angles (u around the axis, v around the tube).
  Vec3 surface(double u, double v) const;
  /// Point of the core circle.
  Vec3 core(double u) const;
};

/// Foot of a point on a torus.
struct Foot {
  double distance = 0.0;       ///< signed, negative inside the tube
  Vec3 normal = Vec3::Zero();  ///< outward unit normal at the foot: gradient of the distance
  Vec3 point = Vec3::Zero();
};

/// Closest point of the torus's surface to x. Round tubes: x's distance to the core circle minus r. Others:
/// Lagrange multiplier of the plane ellipse, (a X/(t + a^2))^2 + (b Y/(t + b^2))^2 = 1, by Newton from the
/// left of its largest root, where the left side is convex and falls.
Foot foot(const Torus& torus, const Vec3& x);

/// The same torus as a kernel body riding on an element that carries only it.
Body kernel_body(const Torus& torus);
Pose kernel_pose(const Torus& torus);
Torus from_kernel(const Body& body, const Pose& pose);

/// Linking number of the core circles by Gauss's double integral, trapezoidal rule refined until two
/// successive values round to the same integer and lie within 0.1 of it.
int gauss_linking(const Torus& a, const Torus& b);

}  // namespace hauberk::brute
