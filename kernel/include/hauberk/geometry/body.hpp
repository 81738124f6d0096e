#pragma once
/// Bodies: primitives as the mechanics uses them, scaled by the characteristic length and attached to a
/// placed element.

#include <hauberk/scene.hpp>

namespace hauberk {

class Facets;

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

  bool is_tube() const { return kind == PrimitiveKind::circle_tube; }
  /// Radius of the largest ball that passes through the hole.
  double hole() const { return R - r0; }
};

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
