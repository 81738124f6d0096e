#pragma once
/// The distance of two tori for very many pairs: coarse samples and Newton's method, in double; and to fifty
/// digits for a few. Nothing here calls the kernel, and the roles of the two tori are the other way round: of
/// two round tubes the larger ring is probed, of a mixed pair the elliptical one over its surface.

#include "minima.hpp"

namespace hauberk::brute {

/// A closest place found on the probed torus: an upper bound of the distance of the surfaces, and the
/// distance if the search missed nothing. Negative where they overlap.
struct NearestPlace {
  double distance = 0.0;
  bool probes_a = true;        ///< which torus is probed
  Vec3 normal = Vec3::Zero();  ///< from a to b
};

/// Samples around and across the probed torus, and Newton's method from the lowest places that are no higher
/// than their neighbours. About 2 to 200 microseconds.
NearestPlace nearest_place(const Torus& a, const Torus& b);

/// The same, probing both tori, with four times the samples each way.
double dense_distance(const Torus& a, const Torus& b);

/// What fifty digits say about a bound of a pair given in double.
struct PreciseSlack {
  double distance;  ///< rounded
  double slack;     ///< distance - bound, computed to fifty digits, then rounded
};

/// Probes both tori: all places that a dense grid in double finds near the lowest are polished by Newton's
/// method in Boost.Multiprecision (cpp_bin_float_50), the closest counts.
PreciseSlack precise_slack(const Torus& a, const Torus& b, double bound);

}  // namespace hauberk::brute
