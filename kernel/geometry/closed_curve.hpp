#pragma once
/// Closed smooth curves: the cores of curve tubes.

#include "geometry/angle.hpp"

#include <hauberk/shape.hpp>

#include <array>
#include <limits>
#include <vector>

namespace hauberk {

/// A point of a curve with its first two derivatives in the curve's coordinate.
struct CurvePoint {
  Vec3 x, xu, xuu;
};

/// x(u) = sum over k of c_k cos k u + s_k sin k u, k = 1, 2, ..., u in radians, in the frame of its body.
/// Immutable: thread safe.
class ClosedCurve {
 public:
  /// At least one harmonic. `scale` multiplies all of them.
  ClosedCurve(std::vector<Harmonic> harmonics, double scale);

  CurvePoint at(const Angle& u) const;
  std::size_t size() const { return harmonics_.size(); }
  const std::vector<Harmonic>& harmonics() const { return harmonics_; }

  /// Bounds of |x| and of the length of its first three derivatives, at most a few per cent above the
  /// largest.
  double radius() const { return bounds_[0]; }
  double first() const { return bounds_[1]; }
  double second() const { return bounds_[2]; }
  double third() const { return bounds_[3]; }
  /// Smallest radius of curvature over a fine sampling; 0 where the curve stands still.
  double tightest_bend() const { return bend_; }

 private:
  std::vector<Harmonic> harmonics_;
  std::array<double, 4> bounds_{};
  double bend_ = std::numeric_limits<double>::infinity();
};

/// Radius of the circle with the same mean square distance from the mean point: sqrt(sum (|c|^2 + |s|^2)/2).
double mean_radius(const std::vector<Harmonic>& harmonics);

}  // namespace hauberk
