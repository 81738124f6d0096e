#pragma once
/// Interface for parametric shapes: parameters in, primitives in the element frame out.

#include <hauberk/linalg.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

class Solid;
class TriangleSurface;

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
  /// Tube of constant radius around a closed smooth curve: size = (-, r, r), core x(u) = sum of c_k cos k u +
  /// s_k sin k u over `curve`. The kernel sets size[0] to the mean radius sqrt(sum (|c_k|^2 + |s_k|^2)/2).
  curve_tube,
  /// Closed surface of flat triangles: R times the points of `surface`, whose mean distance from the origin
  /// is
  /// 1, so R is the mean distance of its points from `position`. Contact "mesh" knows it, and nothing else.
  /// The kernel sets size[1] = size[2] to R times the surface's thickness.
  triangle_mesh,
  /// What `solid` says, by its own sizes. The kernel sets size to its radius and, twice, to its thickness.
  solid,
};

/// Its name in results.
inline const char* name_of(PrimitiveKind kind)
{
  switch (kind) {
    case PrimitiveKind::circle_tube:
      return "circle_tube";
    case PrimitiveKind::revolved_ellipse:
      return "revolved_ellipse";
    case PrimitiveKind::curve_tube:
      return "curve_tube";
    case PrimitiveKind::triangle_mesh:
      return "triangle_mesh";
    case PrimitiveKind::solid:
      return "solid";
  }
  return "";
}

/// Coefficients of cos k u and sin k u of a closed curve, in the primitive's frame.
struct Harmonic {
  Vec3 c = Vec3::Zero(), s = Vec3::Zero();
};

/// A closed surface, placed in the element frame. Plain data; thread safe to read.
struct Primitive {
  std::string name;
  PrimitiveKind kind = PrimitiveKind::circle_tube;
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();  ///< columns are the primitive's axes in the element frame
  std::array<double, 3> size{};      ///< R, r0, r1
  std::vector<Harmonic> curve;       ///< of a curve tube: k = 1, 2, ...; its mean point is `position`
  std::shared_ptr<const TriangleSurface> surface;  ///< of a triangle mesh; else null
  std::shared_ptr<const Solid> solid;              ///< of a solid; else null

  double R() const { return size[0]; }
  double r0() const { return size[1]; }
  double r1() const { return size[2]; }
};

/// Number of geometric quantities that every primitive has: position (3), then size (3).
inline constexpr int primitive_dofs = 6;
/// Places of the sizes among them.
enum SizeQuantity : int { quantity_R = 3, quantity_r0 = 4, quantity_r1 = 5 };
/// Number of those of a harmonic of its curve: c (3), then s (3).
inline constexpr int harmonic_dofs = 6;

/// Number of those of its rotation, where it depends on parameters; see PrimitiveJacobian.
inline constexpr int rotation_dofs = 3;

/// All geometric quantities of a primitive but its rotation; harmonics, or the sizes of a solid, last.
int geometric_dofs(const Primitive& primitive);

/// d(position, size, curve or sizes of a solid)/d(parameters), row-major geometric_dofs x parameter count.
/// The row of R of a curve tube is not used, nor are those of r0 and r1 of a triangle mesh, nor the three of
/// a solid's `size`.
///
/// Three more rows at the end say how the rotation Q turns; without them it is constant. They are the
/// components of the vector omega in the element frame with
///
///     dQ/dp = skew(omega) Q,
///
/// in radians per unit of the parameter: `degree` times as much per degree. (For Q = exp(skew(w)) Q0 and
/// components of w as parameters they are the columns of rotation_exp_jacobian(w).)
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
  /// depend on p, nor must the number of harmonics, the surface of a triangle mesh or the kind of a solid. A
  /// primitive that is a circle_tube for r0 == r1 may change its kind with p. Throws InputError naming the
  /// parameter when p is inadmissible (for instance r0 >= R).
  std::vector<Primitive> primitives(std::span<const double> p) const;

  /// Jacobian of each primitive's (position, size, curve, rotation) with respect to p: all of them have the
  /// rows of the rotation, which are nought where the implementation gives none.
  std::vector<PrimitiveJacobian> jacobians(std::span<const double> p) const;

 protected:
  virtual const std::vector<ParameterInfo>& do_parameters() const = 0;
  virtual void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const = 0;
  /// Without the last three rows of a Jacobian, the primitive's rotation does not depend on p.
  virtual void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const = 0;
};

}  // namespace hauberk
