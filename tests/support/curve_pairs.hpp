#pragma once
/// Tubes around curves for tests.

#include "geometry/closed_curve.hpp"
#include "geometry/pair_frame.hpp"

#include <random>

namespace hauberk::test {

Primitive circle(double R, double r);
Primitive ellipse(double R, double r0, double r1);
Primitive curve_tube(std::vector<Harmonic> harmonics, double r);
/// The circle as a curve.
Primitive circle_curve(double R, double r);
/// An oval link with random second and third harmonics of about `size`.
Primitive wavy(double size, double r, std::mt19937_64& rng);
/// Torus knot of p turns around the axis and q up and down: radius 1, width 0.4.
Primitive knot(int p, int q, double r);

/// Two bodies in place; the second element lies at the origin.
struct Couple {
  Body A, B;
  Pose pose;

  Couple(const Primitive& a, const Primitive& b, const Pose& pose_a = {})
      : A(make_body(a, 0, 0, 1.0)), B(make_body(b, 1, 0, 1.0)), pose(pose_a)
  {
  }
  PairFrame frame() const { return {A, pose, B, Pose{}}; }
};

/// A pose in which rings of radius about 1 are likely to be linked, turned by up to `turn` from a right
/// angle.
Pose linked_pose(double distance, double turn, std::mt19937_64& rng);

}  // namespace hauberk::test
