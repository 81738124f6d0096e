#pragma once
/// The surfaces of primitives, evaluated by themselves.

#include "model.hpp"

namespace hauberk::verification {

ProbeAngles probe_angles(double u, double v);

/// Place of b in the frame in which a's place is given: first b, then a.
Place compose(const Place& a, const Place& b);

/// The torus in space when its element has the given place.
Primitive placed(const Primitive& torus, const Place& element);

/// Signed distance of x to the surface: negative inside. Exact to rounding: the closest point lies in the
/// meridian plane of x, and there on the quarter of the ellipse that x is nearest to, where the derivative of
/// the squared distance by the angle changes sign once. Of a curve the closest point is the lowest of many
/// tried. Of a solid it is what the plugin says. `outward`, when wanted, is the unit normal at the closest
/// point.
double signed_distance(const Primitive& torus, const Vec3& x, Vec3* outward = nullptr);

/// True for surfaces at a constant distance r0 from a core, which is a curve; also of meshes.
bool is_tube(const Primitive& torus);
/// Point of the core and its derivative in u.
Vec3 core_point(const Primitive& torus, double u);
Vec3 core_tangent(const Primitive& torus, double u);
/// Bounds of the distance of its points from its centre, and of the lengths of its first and second
/// derivatives.
double core_reach(const Primitive& torus);
double core_speed(const Primitive& torus);
double core_bend(const Primitive& torus);
/// Bound of the distance of points of the surface from its centre; of surfaces of triangles the largest.
double reach(const Primitive& torus);
/// Point of the surface, V(u, v), and its derivatives in u and v; of solids whose probe is their surface.
Vec3 surface_point(const Primitive& torus, double u, double v);
std::array<Vec3, 2> surface_tangents(const Primitive& torus, double u, double v);

}  // namespace hauberk::verification
