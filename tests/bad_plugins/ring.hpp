#pragma once
/// What plugins of these tests make, where it has to be right.

#include <hauberk/shape.hpp>

namespace hauberk {

/// One round ring of fixed size.
class Ring final : public Shape {
 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double>, std::vector<Primitive>& out) const override
  {
    Primitive ring;
    ring.name = "ring";
    ring.size = {5.0, 0.5, 0.5};
    out = {ring};
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out.assign(1, PrimitiveJacobian{});
  }

 private:
  std::vector<ParameterInfo> parameters_;
};

}  // namespace hauberk
