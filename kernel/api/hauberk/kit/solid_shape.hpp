#pragma once
/// A shape of one solid: what a plugin registers that has a new primitive and nothing else.

#include <hauberk/kit/implicit_solid.hpp>
#include <hauberk/shape.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk::kit {

/// The element is the solid itself, at its origin; parameters are its sizes, in their order and by their
/// names, as `Author::parameters()` declares them. Where the author has `check(const double* q)`, it throws
/// InputError for sizes that are none.
template <class Author>
class SolidShape : public Shape {
 public:
  explicit SolidShape(std::string name) : name_(std::move(name)), parameters_(Author::parameters()) {}

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }

  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    if constexpr (requires { Author::check(p.data()); }) Author::check(p.data());
    Primitive solid;
    solid.name = name_;
    solid.kind = PrimitiveKind::solid;
    solid.solid = solids_.get(p, [p] {
      return std::make_shared<const ImplicitSolid<Author>>(std::vector<double>(p.begin(), p.end()));
    });
    out.assign(1, solid);
  }

  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    const std::size_t n = p.size();
    out.assign(1, PrimitiveJacobian((primitive_dofs + n) * n, 0.0));
    for (std::size_t k = 0; k < n; ++k) out[0][(primitive_dofs + k) * n + k] = 1.0;
  }

 private:
  std::string name_;
  std::vector<ParameterInfo> parameters_;
  KeptSolids<ImplicitSolid<Author>> solids_;
};

}  // namespace hauberk::kit
