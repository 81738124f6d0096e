#pragma once
/// A straight strut that something else is said of.

#include "shapes/strut_frame/capsule.hpp"

namespace hauberk::test {

/// All that a Capsule says of itself, but sizes of others, to be overridden where a test needs it.
class DelegatingStrut : public Solid {
 public:
  DelegatingStrut(double h, double r) : strut_(h, r) {}

  std::string kind() const override { return strut_.kind(); }
  std::vector<std::string> size_names() const override { return strut_.size_names(); }
  const std::vector<double>& sizes() const override { return strut_.sizes(); }
  double radius() const override { return strut_.radius(); }
  double thickness() const override { return strut_.thickness(); }
  int probe_dimension() const override { return strut_.probe_dimension(); }
  double offset() const override { return strut_.offset(); }
  Fold fold() const override { return strut_.fold(); }
  ProbeDerivatives probe(const ProbeAngles& at) const override { return strut_.probe(at); }
  ProbeBounds probe_bounds(double u, double v, double half_u, double half_v) const override
  {
    return strut_.probe_bounds(u, v, half_u, half_v);
  }
  Vec3 surface_point(const ProbeAngles& at) const override { return strut_.surface_point(at); }
  SolidDistance distance(const Vec3& x) const override { return strut_.distance(x); }
  SolidSmoothness smoothness() const override { return strut_.smoothness(); }
  void distance_sizes(const Vec3& x, std::span<double> out) const override { strut_.distance_sizes(x, out); }
  void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const override
  {
    strut_.probe_sizes(at, n, out);
  }
  std::vector<std::vector<Vec3>> cores() const override { return strut_.cores(); }

 private:
  Capsule strut_;
};

}  // namespace hauberk::test
