#include "guarded.hpp"

namespace hauberk {
namespace {

class GuardedShape final : public Shape {
 public:
  GuardedShape(std::unique_ptr<Shape> inner, const Guard& guard)
      : inner_(std::move(inner)),
        guard_(guard),
        parameters_(guard_("parameters", [&] { return inner_->parameters(); }))
  {
  }

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    guard_.with_process_state("primitives", [&] { out = inner_->primitives(p); });
  }
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    guard_.with_process_state("jacobians", [&] { out = inner_->jacobians(p); });
  }

 private:
  std::unique_ptr<Shape> inner_;
  Guard guard_;
  std::vector<ParameterInfo> parameters_;
};

}  // namespace

std::unique_ptr<Shape> guard_shape(std::unique_ptr<Shape> shape, const Guard& guard)
{
  return std::make_unique<GuardedShape>(std::move(shape), guard);
}

}  // namespace hauberk
