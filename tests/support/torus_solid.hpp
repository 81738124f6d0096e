#pragma once
/// A torus that the kernel does not know: written as a plugin's solid by hand, without the kit.

#include <hauberk/shape.hpp>
#include <hauberk/solid.hpp>

#include <cmath>
#include <memory>

namespace hauberk::test {

/// Sizes R and r. Probed along its core (dimension 1) or over its surface (2).
class TorusSolid final : public Solid {
 public:
  TorusSolid(double R, double r, int dimension) : sizes_{R, r}, dimension_(dimension) {}

  std::string kind() const override { return "test_torus"; }
  std::vector<std::string> size_names() const override { return {"R", "r"}; }
  const std::vector<double>& sizes() const override { return sizes_; }
  double radius() const override { return sizes_[0] + sizes_[1]; }
  double thickness() const override { return sizes_[1]; }
  int probe_dimension() const override { return dimension_; }
  double offset() const override { return dimension_ == 1 ? sizes_[1] : 0.0; }
  Fold fold() const override { return Fold::none; }
  ProbeDerivatives probe(const ProbeAngles& at) const override;
  ProbeBounds probe_bounds(double at_u, double at_v, double half_u, double half_v) const override;
  Vec3 surface_point(const ProbeAngles& at) const override;
  SolidDistance distance(const Vec3& x) const override;
  SolidSmoothness smoothness() const override;
  void distance_sizes(const Vec3& x, std::span<double> out) const override;
  void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const override;
  std::shared_ptr<const Solid> with_sizes(std::span<const double> sizes) const override
  {
    return std::make_shared<const TorusSolid>(sizes[0], sizes[1], dimension_);
  }
  double speed(std::span<const double> sizes) const override
  {
    return std::abs(sizes[0] - sizes_[0]) + std::abs(sizes[1] - sizes_[1]);
  }
  std::vector<std::vector<Vec3>> cores() const override;

 private:
  std::vector<double> sizes_;
  int dimension_;
};

/// It as a primitive at the origin.
Primitive torus_solid(double R, double r, int dimension);

/// A shape of it: parameters R and r.
class TorusSolidShape final : public Shape {
 public:
  explicit TorusSolidShape(int dimension);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  int dimension_;
  std::vector<ParameterInfo> parameters_;
};

}  // namespace hauberk::test
