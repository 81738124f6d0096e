#pragma once
/// A rigid union of tori whose radii are the design parameters, placed by numbers or by those parameters.

#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// One torus: where it sits in the element frame and whose radii it has. Lengths in file units.
struct Torus {
  std::string name;
  int group = 0;  ///< its radii are parameters 3 group (R), 3 group + 1 (r0) and 3 group + 2 (r1)
  Mat3 rotation = Mat3::Identity();  ///< columns are its axes, the third one the axis of revolution
  /// position = offset + direction * sum_k weights[k] p[k]; weights is empty when it does not depend on p.
  Vec3 offset = Vec3::Zero();
  Vec3 direction = Vec3::Zero();
  std::vector<double> weights;
};

/// Union of tori with elliptical or circular cross-section. Tori of one group share R, r0 and r1.
class TorusUnion final : public Shape {
 public:
  /// `prefixes` name the groups: parameters are <prefix>.R, <prefix>.r0 and <prefix>.r1, in this order.
  TorusUnion(const std::vector<std::string>& prefixes, std::vector<Torus> tori);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  /// Throws InputError naming the parameter where a hole is closed (r0 >= R).
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<ParameterInfo> parameters_;
  std::vector<Torus> tori_;
};

/// The fields of the shape's section of an experiment.
void torus_union_fields(std::vector<Field>& out);

/// Builds the shape from a section checked against these fields. Everything else that is wrong goes to
/// `problems`; then null is returned.
std::unique_ptr<Shape> make_torus_union(const Node& section, Problems& problems);

}  // namespace hauberk
