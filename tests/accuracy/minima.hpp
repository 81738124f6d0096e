#pragma once
/// All local minima of the distance between two tori by dense sampling and descent.

#include "torus.hpp"

#include <vector>

namespace hauberk::brute {

/// A local minimum of the distance from P (probed) to F.
struct BruteMinimum {
  double u = 0.0, v = 0.0;  ///< on P: core angle for a round tube, else surface angles
  double distance = 0.0;    ///< of the surfaces
};

/// The distance of a probe point of P to F: P's core points when P is round (minus its radius), else its
/// surface points.
struct Field {
  const Torus& P;
  const Torus& F;

  bool curve() const { return P.round(); }
  double value(double u, double v) const;
  /// Value and gradient by the envelope theorem: n . dp/du, n . dp/dv.
  double value(double u, double v, double& gu, double& gv) const;
};

/// Numbers of samples: along P for a round P; around and across P otherwise. `density` 1 resolves features
/// of one hundredth of the smaller ring.
struct Sampling {
  int curve = 2048;
  int around = 256, across = 64;
};

/// Every minimum that the sampling sees (samples no higher than their neighbours), refined by descent to
/// rounding, in rising order of distance.
std::vector<BruteMinimum> all_minima(const Torus& P, const Torus& F, const Sampling& sampling = {});

/// Smallest distance between the surfaces; probes whichever of the two is cheaper. Negative if they overlap.
double surface_distance(const Torus& a, const Torus& b, const Sampling& sampling = {});

/// The same, probing both: also negative where one tube lies wholly inside the other.
double solid_distance(const Torus& a, const Torus& b);

/// How far one has to rise from `from` on the way to (u, v): along the straight line between the two angle
/// pairs, with v descending on the way for surfaces. An upper bound of the depth of the minimum.
double climb(const Field& field, const BruteMinimum& from, double u, double v);

/// How far the distance rises within `reach` radians of u to either side of a minimum when v descends on the
/// way; the smaller of the two sides. Zero where whole families of points are equally far.
double rise_along_valley(const Field& field, const BruteMinimum& from, double reach);

/// Smallest eigenvalue of the Hessian in arc lengths, by central differences of the gradient.
double lowest_curvature(const Field& field, double u, double v);

}  // namespace hauberk::brute
