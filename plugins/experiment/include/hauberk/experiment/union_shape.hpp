#pragma once
/// Rigid unions of shapes, the one shape that is no plugin: "shape": "union" in an experiment. A plugin
/// cannot load others, so the reader of experiments makes the parts through the registry and puts them
/// together.

#include <hauberk/plugin.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// A shape with its place in the element.
struct UnionPart {
  std::string name;
  std::shared_ptr<const Shape> shape;
  Mat3 rotation = Mat3::Identity();  ///< columns are the part's axes in the element frame where no parameter
                                     ///< turns it
  Vec3 position = Vec3::Zero();      ///< of the part's origin unless parameters say otherwise; file units
};

/// Names of the parameters that place a part: its position, and the rotation vector.
inline constexpr std::array<const char*, 6> place_parameters{"x", "y", "z", "rx", "ry", "rz"};

/// Union of the primitives of all parts, each part placed rigidly: a primitive with the place (x, Q) in its
/// part has
///
///     x' = t + A x,   Q' = A Q,   A = exp(skew(w)) A0
///
/// in the element, where t is the part's position, A0 its fixed rotation, and w a rotation vector about its
/// origin in the element frame; all components of t and w are parameters, those of w in degrees. Sizes,
/// curves, surfaces and solids of primitives are in their own frames and stay as they are. So with the part's
/// parameters q, by which Q turns with omega_q, and J = rotation_exp_jacobian(w), whose columns are omega_k,
///
///     dx'/dq = A dx/dq,   dx'/dt = I,   dx'/dw_k = omega_k x A x,
///     dQ'/dq = skew(A omega_q) Q',      dQ'/dw_k = skew(omega_k) Q'.
///
/// Parameters are, part after part, those of its shape as NAME.PARAMETER, then NAME.x, NAME.y, NAME.z,
/// NAME.rx, NAME.ry and NAME.rz (place_parameters); primitives are called NAME.PRIMITIVE. Names of parts have
/// no '.', so no two of different parts are equal. Immutable, thread safe. What a part throws passes through
/// with "part 'NAME': " before its message.
class UnionShape final : public Shape {
 public:
  explicit UnionShape(std::vector<UnionPart> parts);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<UnionPart> parts_;
  std::vector<std::size_t> first_;  ///< per part: its first parameter; and one past the last of all
  std::vector<ParameterInfo> parameters_;
};

/// What is said of the shape `union` where plugins are described: id, summary, fields. It is no plugin, and
/// its factory is null: PluginResolver makes it.
const PluginTable& union_table();

/// Name of the object in the fields of `union` that describes a part, by which plugin_section knows it.
inline constexpr const char* union_part_field = "union_part";

}  // namespace hauberk
