#pragma once
/// Bodies: primitives as the mechanics uses them, scaled by the characteristic length and attached to a
/// placed element.

#include "geometry/pose.hpp"

#include <hauberk/shape.hpp>

namespace hauberk {

class ClosedCurve;
class Facets;
class Solid;
class TriangleSurface;

/// A primitive of a placed element, lengths scaled by L, placed in the element frame.
struct Body {
  int element = 0;  ///< placed element it belongs to
  int index = 0;    ///< index among the element's primitives
  PrimitiveKind kind = PrimitiveKind::circle_tube;
  double R = 0.0, r0 = 0.0, r1 = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
  double bound = 0.0;  ///< radius of a sphere about `center` that holds the surface
  double reach = 0.0;  ///< radius of a sphere about the element's origin that holds the surface
  /// Mesh that stands for the surface in contact; null: the surface itself.
  std::shared_ptr<const Facets> facets;
  /// Core of a curve tube, in the frame of the body; else null.
  std::shared_ptr<const ClosedCurve> curve;
  /// Of a curve tube: a tube as thick around a circle of no radius, which is a ball. See PairFrame.
  std::shared_ptr<const Body> point;
  /// Of a triangle mesh: its surface is R times this; else null. Then r0 = r1 is its thickness, which says
  /// how thin it is and nothing else, and only `facets` know where it is.
  std::shared_ptr<const TriangleSurface> surface;
  /// What is known of a solid, in lengths of its own, `unit` of which are one of the body's; else null. Then
  /// R is its radius and r0 = r1 its thickness, which say how large it is and nothing else.
  std::shared_ptr<const Solid> solid;
  double unit = 1.0;

  bool is_circle_tube() const { return kind == PrimitiveKind::circle_tube; }
  bool is_ellipse() const { return kind == PrimitiveKind::revolved_ellipse; }
  /// One of the two kinds that have an axis, or a ball.
  bool is_torus() const { return kind <= PrimitiveKind::revolved_ellipse; }
  /// A ball of radius r0.
  bool is_point() const { return R == 0.0; }
  /// Radius of a ball about `center` that holds the core
  /// (of a triangle mesh, which has none, the mesh; of a solid all of it).
  double core_bound() const { return curve ? bound - r0 : surface ? bound : R; }
};

/// Gives a body the core `curve` (scaled lengths) of a tube of radius r.
void set_core(Body& body, std::shared_ptr<const ClosedCurve> curve, double r);

/// True of two solids of one kind with the same sizes, and of two bodies that are none.
bool same_solid(const Body& a, const Body& b);

/// 1 or 2.
int solid_probe_dimension(const Body& body);

/// Scales a primitive by 1/length.
Body make_body(const Primitive& primitive, int element, int index, double length);

/// A body's world frame for a given element pose: centre and axes.
struct Frame {
  Vec3 center;
  Mat3 axes;
};

inline Frame world_frame(const Body& body, const Pose& pose)
{
  return {pose.position + pose.rotation * body.center, pose.rotation * body.axes};
}

}  // namespace hauberk
