#pragma once
/// Bodies on the way from one design to another.

#include "geometry/body.hpp"

namespace hauberk {

/// The body at the share t of the way from a to b: sizes and the centre c are interpolated linearly, and the
/// axes turn evenly about one axis, the shorter way,
///
///     A(t) = exp(t skew(psi)) A_a,   psi = rotation_log(A_b A_a^T).
///
/// Its kind is that of `b` unless both are tubes; of a solid that cannot be made `solid` is null. Throws
/// PluginError where a and b are curves with different numbers of harmonics. Thread safe.
Body body_between(const Body& a, const Body& b, double t);

/// Bound of the speed of its surface in the frame of the element, per unit of t. Surface points x in the
/// frame of the body move with |x'| <= v by its change of sizes, so
///
///     |d(c + A x)/dt| <= |c'| + |psi| |x| + v,   |x| <= min(bound_a + t v, bound_b + (1 - t) v),
///
/// and the smaller of these two is at most half of their sum. Thread safe.
double shape_speed(const Body& a, const Body& b);

}  // namespace hauberk
