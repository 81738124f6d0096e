#pragma once
/// Certified lower bound of the distance between two bodies.

#include "geometry/panel_bound.hpp"

namespace hauberk {

/// Bounds of the smallest gap of a pair of bodies.
struct Separation {
  double lower = 0.0;   ///< never above the gap (up to rounding of about 1e-15 L)
  double upper = 0.0;   ///< gap at the closest probe point seen: never below the gap
  int evaluations = 0;  ///< closest-point evaluations spent
};

/// Lower bound of the gap of a pair from the balls that hold its surfaces; nothing is evaluated. Thread safe.
double ball_gap(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b, double clearance);

/// Gaps of two placed bodies at or below this are none: rounding decides their sign.
double gap_rounding(const PairFrame& frame);

/// Branch and bound over panels of the probing body with `panel_bound`: a panel is split until its bound is
/// at least `tightness` times the smallest gap seen, or at least `enough`. Gaps are surface distances minus
/// `clearance`, here and in the result. So lower >= min(enough, tightness * upper) whenever the gap is
/// positive; otherwise lower <= upper <= 0. A surface wholly inside of the other overlaps it. Where the gap
/// is below rounding lower is 0; where it is near rounding all along two surfaces, which takes millions of
/// panels, lower may be less than promised. Throws InputError for triangle meshes, which only
/// facets know. Thread safe.
Separation separation(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b, double clearance,
                      double enough, double tightness = 0.5);

/// Number of times the core circle of A crosses the disc of B, counted with sign: the linking number of the
/// two circles. Exact up to rounding as long as the cores do not touch. Symmetric up to sign.
///
/// With a triangle mesh, the greatest common divisor of the linking numbers of all loops of one body's facets
/// with all of the other's: kept by every motion without intersection, and for two solid tori the size of
/// their cores' linking number. Throws InputError where bodies have no facets.
int linking_number(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b);

}  // namespace hauberk
