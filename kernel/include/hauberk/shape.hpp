#pragma once
/// Interface for parametric shapes: parameters in, primitives in the element frame out.

#include <hauberk/linalg.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// One design parameter of a shape. Lengths are in the unit of the experiment file.
struct ParameterInfo {
  std::string name;
  std::string unit;            ///< "length", "degree" or "1"
  double default_value = 0.0;  ///< NaN: none, every experiment must give a value
  double lower = 0.0;          ///< values outside [lower, upper] are refused
  double upper = 0.0;
  std::string doc;
  bool smooth = true;  ///< primitives depend on it with continuous derivative
};

/// The least general exact description of a closed surface.
enum class PrimitiveKind {
  /// Tube of constant radius around a circle: size = (R, r, r). Surface distance to it is the distance
  /// to the circle minus r.
  circle_tube,
  /// Ellipse revolved about the local z axis, paper eq. (1): size = (R, r0, r1),
  /// V = ((R + r0 cos v) cos u, (R + r0 cos v) sin u, r1 sin v).
  revolved_ellipse,
};

/// A closed surface, placed in the element frame. Plain data; thread safe to read.
struct Primitive {
  std::string name;
  PrimitiveKind kind = PrimitiveKind::circle_tube;
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();  ///< columns are the primitive's axes in the element frame
  std::array<double, 3> size{};      ///< R, r0, r1

  double R() const { return size[0]; }
  double r0() const { return size[1]; }
  double r1() const { return size[2]; }
};

/// Number of geometric quantities of a primitive: position (3), then size (3).
inline constexpr int primitive_dofs = 6;

/// d(position, size)/d(parameters), row-major primitive_dofs x parameter count. Rotations of primitives do
/// not depend on parameters.
using PrimitiveJacobian = std::vector<double>;

/// A parametric element: a union of primitives. Immutable after construction, so all calls are thread safe.
///
/// The public calls check sizes and finiteness and throw PluginError; implementations override `do_...`.
class Shape {
 public:
  virtual ~Shape() = default;

  /// Declared once; the order is that of every parameter vector.
  const std::vector<ParameterInfo>& parameters() const { return do_parameters(); }

  /// Primitives at parameters p (lengths in file units). Number, kind-independent names and order must not
  /// depend on p. A primitive that is a circle_tube for r0 == r1 may change its kind with p.
  /// Throws InputError naming the parameter when p is inadmissible (for instance r0 >= R).
  std::vector<Primitive> primitives(std::span<const double> p) const;

  /// Jacobian of each primitive's (position, size) with respect to p.
  std::vector<PrimitiveJacobian> jacobians(std::span<const double> p) const;

 protected:
  virtual const std::vector<ParameterInfo>& do_parameters() const = 0;
  virtual void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const = 0;
  virtual void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const = 0;
};

}  // namespace hauberk
