#pragma once
/// A straight strut: all points within r of the segment from -h to h on the axis z, every formula in closed
/// form.

#include <hauberk/solid.hpp>

#include <cmath>
#include <limits>
#include <memory>

namespace hauberk {

/// Sizes h and r, both positive. With b = z - clamp(z, -h, h) the distance is |(x, y, b)| - r.
///
/// The probe is the segment, x(u) = h cos u, which is run through there and back: at its ends it stands
/// still, so that a contact at an end is a minimum like any other.
class Capsule final : public Solid {
 public:
  Capsule(double h, double r) : sizes_{h, r} {}

  std::string kind() const override { return "capsule"; }
  std::vector<std::string> size_names() const override { return {"h", "r"}; }
  const std::vector<double>& sizes() const override { return sizes_; }
  double radius() const override { return sizes_[0] + sizes_[1]; }
  double thickness() const override { return sizes_[1]; }
  int probe_dimension() const override { return 1; }
  double offset() const override { return sizes_[1]; }
  Fold fold() const override { return Fold::mirror; }
  ProbeDerivatives probe(const ProbeAngles& at) const override;
  ProbeBounds probe_bounds(double at_u, double at_v, double half_u, double half_v) const override;
  Vec3 surface_point(const ProbeAngles& at) const override;
  SolidDistance distance(const Vec3& x) const override;
  /// The solid is convex; curvature jumps where the cylinder meets the caps.
  SolidSmoothness smoothness() const override
  {
    return {1.0 / sizes_[1], std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  }
  void distance_sizes(const Vec3& x, std::span<double> out) const override;
  void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const override;
  std::shared_ptr<const Solid> with_sizes(std::span<const double> sizes) const override
  {
    return std::make_shared<const Capsule>(sizes[0], sizes[1]);
  }
  /// Ends move by what h changes, everything by what r changes.
  double speed(std::span<const double> sizes) const override
  {
    return std::abs(sizes[0] - sizes_[0]) + std::abs(sizes[1] - sizes_[1]);
  }
  std::vector<std::vector<Vec3>> cores() const override { return {}; }

 private:
  /// From the nearest point of the segment to x.
  Vec3 from_segment(const Vec3& x) const;

  std::vector<double> sizes_;
};

}  // namespace hauberk
