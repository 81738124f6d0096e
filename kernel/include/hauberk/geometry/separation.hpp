#pragma once
/// Certified lower bound of the distance between two bodies.

#include <hauberk/geometry/pair_frame.hpp>

namespace hauberk {

/// Bounds of the smallest surface distance of a pair of bodies.
struct Separation {
  double lower = 0.0;     ///< never above the distance (up to rounding of about 1e-15 L)
  double upper = 0.0;     ///< distance at the closest probe point seen: never below the distance
  int evaluations = 0;    ///< closest-point evaluations spent
};

/// Branch and bound over panels of the probing body with `panel_bound`: a panel is split until its bound is
/// at least `tightness` times the smallest distance seen, or at least `enough`. So lower >= min(enough,
/// tightness * upper) whenever the bodies are apart; a pair in contact or deeper gives lower <= 0.
/// Distances are surface to surface, without clearance. Thread safe.
Separation separation(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b, double enough,
                      double tightness = 0.5);

/// Number of times the core circle of A crosses the disc of B, counted with sign: the linking number of the
/// two circles. Exact up to rounding as long as the cores do not touch. Symmetric up to sign.
int linking_number(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b);

}  // namespace hauberk
