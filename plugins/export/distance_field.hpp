#pragma once
/// Fields of primitives, and the surfaces where the least of several is zero.

#include "export/mesh.hpp"
#include "geometry/closed_curve.hpp"

#include <optional>
#include <vector>

namespace hauberk::exporting {

/// A function of the element's frame that is negative inside of a primitive, zero on its surface and positive
/// outside, and changes by at most the distance of two points.
class DistanceField {
 public:
  /// Throws InputError for a triangle mesh, which has none.
  explicit DistanceField(const Primitive& primitive);
  double operator()(const Vec3& x) const;
  /// A box that holds the surface, widened by `by`.
  void extend(Vec3& low, Vec3& high, double by) const;

 private:
  double around_curve(const Vec3& x) const;

  Primitive primitive_;
  std::optional<ClosedCurve> curve_;  ///< core of a curve tube
  std::vector<Vec3> core_;            ///< points of it, evenly in the coordinate
  double radius_ = 0.0;               ///< of a ball about the primitive's position that holds it
};

/// The surface of the union of primitives; see element_mesh.
Mesh zero_set(std::span<const Primitive> primitives, double chord, double most_triangles);

}  // namespace hauberk::exporting
