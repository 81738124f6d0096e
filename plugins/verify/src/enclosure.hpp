#pragma once
/// Smallest distances of pairs with a solid, of which a plugin alone knows where the surface is: between
/// bounds.
#include "model.hpp"

namespace hauberk::verification {

/// Bounds of the smallest signed distance of two surfaces.
struct Enclosure {
  double least = 0.0;  ///< no two points are nearer
  double found = 0.0;  ///< two points are as near as this
};

/// Encloses the smallest distance of two surfaces in space, at least one of which is a solid, by branch and
/// bound. It ends when both bounds are within `width`, when `least` is above `enough`, or after 200 000
/// evaluations of a distance.
///
/// Points of one surface's probe are a constant `offset` from it; phi is the signed distance of the other.
/// Over a cell of the probe's coordinates with the middle x, half-widths s, w and bounds of the probe's
/// derivatives, no point y = x + x_u s' + x_v w' + ... is farther from x than d, so that phi(y) >= phi(x) -
/// d, as distances are 1-Lipschitz. Where the plugin is not certain of phi(x) its `at_least` takes its place,
/// or what balls say that hold all of the other's probe. Where a ball of radius t can touch the other surface
/// from outside anywhere (its reach), phi = t - dist(., {phi >= t}) below t, whose Hessian is at least -1/(t
/// - phi), as that of the distance to a set is at most 1/dist (Cannarsa and Sinestrari, Semiconcave
/// Functions, 2004, prop. 2.2.2). With n = grad phi(x) therefore
///
///     phi(y) >= phi(x) + n . (y - x) - d^2/(2 (t - phi(x) - d)),
///
/// and n . (y - x) is bounded by n . x_u, n . x_v, n . x_uu, n . x_uv, n . x_vv and the third derivatives.
/// Its error is of second order at a minimum and falls with the cell's square, so that the cells around a
/// minimum do not multiply as they are halved.
Enclosure enclose(const Primitive& a, const Primitive& b, double width, double enough);

}  // namespace hauberk::verification
