#pragma once
/// The solid of all balls whose centres and radii follow a closed spline: a canal surface, whose circles are
/// where each ball touches it.

#include "periodic_spline.hpp"

#include <hauberk/kit/lazy.hpp>
#include <hauberk/solid.hpp>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace hauberk {

/// Centre c(t) and radius r(t) of the ball at t, in four dimensions.
using BallSpline = PeriodicSpline<4>;

/// Derivatives of centre and radius at the middle of a stretch of t, and bounds over all of it.
struct Stretch {
  int piece = 0;
  double at = 0.0, half = 0.0;  ///< of s, the part of the piece
  BallSpline::Derivatives d;
  /// Upper bounds of the lengths of derivatives of the centre, of order 1, 2 and 3, and of the radius; of
  /// order 0, how far they are from the middle's.
  std::array<double, 4> centre{}, radius{};
  double slowest = 0.0;                   ///< lower bound of |c'|
  double thinnest = 0.0, thickest = 0.0;  ///< bounds of r

  Stretch(const BallSpline& spline, int piece, double at, double half);
  double t() const { return piece + at; }
};

/// All of a spline in stretches, so many to a piece.
std::vector<Stretch> stretches(const BallSpline& spline, int to_a_piece);

/// Stretches to a piece that leave bounds of radii, which are off by the square of the width, exact enough.
inline constexpr int fine = 32;

/// Sizes: x, y, z and r of each node, which the spline passes at t = 0, 1, ..., n - 1. Outside, the distance
/// from a union of balls is the least of |x - c(t)| - r(t) over t; of its stationary points the derivatives
/// follow from those of the spline.
///
/// The chart: ball t touches the surface where its outward normal m has m . c' = -r', a circle,
///
///     x(t, v) = c + r m,  m = -r'/|c'| T + sqrt(1 - (r'/|c'|)^2) (cos v N + sin v B),
///
/// T = c'/|c'|, N the part of a reference vector a(t) across T, B = N x T; t = n u/(2 pi). The reference does
/// not depend on the sizes, so that coordinates stay where they are while sizes change.
class SplineSolid final : public Solid {
 public:
  /// Of the reference the part across the curve has to be at least this.
  static constexpr double least_across = 0.2;

  /// Four sizes a node. `reference` has the same period.
  SplineSolid(std::vector<double> sizes, std::shared_ptr<const PeriodicSpline<3>> reference);

  /// Why these balls have no smooth surface, or the reference no part across; empty where all is well.
  std::string problem() const;

  std::string kind() const override { return "spline_tube"; }
  std::vector<std::string> size_names() const override;
  const std::vector<double>& sizes() const override { return sizes_; }
  double radius() const override { return radius_; }
  double thickness() const override { return thinnest_; }
  int probe_dimension() const override { return 2; }
  double offset() const override { return 0.0; }
  Fold fold() const override { return Fold::none; }
  ProbeDerivatives probe(const ProbeAngles& at) const override;
  ProbeBounds probe_bounds(double at_u, double at_v, double half_u, double half_v) const override;
  Vec3 surface_point(const ProbeAngles& at) const override { return probe(at).x; }
  SolidDistance distance(const Vec3& x) const override;
  /// No ball bends the surface more than its own radius does.
  SolidSmoothness smoothness() const override;
  void distance_sizes(const Vec3& x, std::span<double> out) const override;
  void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const override;
  std::shared_ptr<const Solid> with_sizes(std::span<const double> sizes) const override;
  /// Balls move by what centres and radii change, and so does their distance from any point; as far as both
  /// reach, a surface point of the one is within that of the other.
  double speed(std::span<const double> sizes) const override;
  std::vector<std::vector<Vec3>> cores() const override;

 private:
  struct Ball {
    double t = 0.0, value = 0.0;
  };
  /// The ball that is nearest to a point.
  Ball nearest_ball(const Vec3& x) const;

  /// x = p + cos v q + sin v w and derivatives in u up to the third over a part of u: centres, and how far
  /// from them.
  struct Part {
    std::array<std::array<Vec3, 4>, 3> center;
    std::array<std::array<double, 4>, 3> off;
  };
  std::vector<Part> parts() const;

  std::vector<double> sizes_;
  std::shared_ptr<const PeriodicSpline<3>> reference_;
  CardinalSpline basis_;
  BallSpline spline_;
  std::vector<Stretch> stretches_;
  double radius_ = 0.0, thinnest_ = 0.0;
  kit::Lazy<std::vector<Part>> parts_;
  kit::Lazy<SolidSmoothness> smoothness_;
};

/// Unit vectors across the curve of a spline at its nodes, carried along it without turning about it and
/// closed by an even turn, as a spline of the same period.
std::shared_ptr<const PeriodicSpline<3>> carried_reference(std::span<const double> sizes);

/// Lower bound of the radius up to which a ball that touches the surface from outside holds no other point
/// of it; not positive where the surface meets itself, or may.
double reach_bound(const BallSpline& spline);
/// The same question, answered as soon as that bound is above 0.
bool meets_itself(const BallSpline& spline);

/// Upper bound of how fast the surface's normal curvature changes along it (SolidSmoothness::change).
double change_bound(const BallSpline& spline);

}  // namespace hauberk
