#pragma once
/// How far two surfaces are apart, by exhaustive search.

#include "enclosure.hpp"

namespace hauberk::verification {

/// Smallest signed distance between two surfaces in space, by exhaustive search.
///
/// One surface (its core circle, when its cross-section is a circle) is divided into cells; the signed
/// distance to the other is 1-Lipschitz, so a cell whose centre is farther than its half-diagonal above the
/// best value found holds no smaller one and is dropped, the others are divided again. Cells that remain at
/// the finest division and are no higher than their neighbours are refined by golden sections. Negative: the
/// surfaces intersect. Of a pair with a solid what `enclose` finds within 1e-12 of their size.
double separation(const Primitive& a, const Primitive& b);

/// The same between bounds: of pairs with a solid as `enclose` has them, of others both are the separation.
Enclosure enclosed_separation(const Primitive& a, const Primitive& b, double width, double enough);

/// Lower bound of the separation: distance of the core circles less the largest half-axes. Exact for circles.
/// Of surfaces of triangles and of solids that of the balls around them.
double separation_bound(const Primitive& a, const Primitive& b);

}  // namespace hauberk::verification
