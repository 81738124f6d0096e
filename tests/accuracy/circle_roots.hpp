#pragma once
/// The stationary distances of two circles as roots of a polynomial: a check without sampling.

#include "minima.hpp"

namespace hauberk::brute {

/// All local minima of the distance of round P's core points to round F, in rising order of distance.
///
/// With p(u) on P's core in F's frame and rho its distance from F's axis, d^2 = |p|^2 + R^2 - 2 R rho is
/// stationary where rho (p . p') = R (x x' + y y'). Squared, both sides are trigonometric polynomials of
/// degree four, so z = exp(iu) is a root of a polynomial of degree eight: eigenvalues of its companion
/// matrix. Roots within 1e-3 of the unit circle are polished on the unsquared equation; minima are where it
/// rises.
std::vector<BruteMinimum> circle_minima(const Torus& P, const Torus& F);

}  // namespace hauberk::brute
