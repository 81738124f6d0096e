#pragma once
/// A shape whose parameters are rotations.

#include <hauberk/shape.hpp>

namespace hauberk::test {

/// Primitives of fixed sizes, each turned about the element's origin by a rotation vector w (radians): a
/// primitive with the place (x, Q) comes to (exp(skew(w)) x, exp(skew(w)) Q). Parameters are wx, wy, wz of
/// one primitive after the other.
class Turned final : public Shape {
 public:
  explicit Turned(std::vector<Primitive> primitives);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<Primitive> primitives_;
  std::vector<ParameterInfo> parameters_;
};

}  // namespace hauberk::test
