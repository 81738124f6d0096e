#include "geometry/body.hpp"

#include "geometry/closed_curve.hpp"

#include <hauberk/solid.hpp>
#include <hauberk/triangle_surface.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace hauberk {

void set_core(Body& body, std::shared_ptr<const ClosedCurve> curve, double r)
{
  body.R = mean_radius(curve->harmonics());
  body.r0 = body.r1 = r;
  body.bound = curve->radius() + r;
  body.curve = nullptr;
  body.point = nullptr;
  auto point = std::make_shared<Body>(body);
  point->kind = PrimitiveKind::circle_tube;
  point->R = 0.0;
  body.point = std::move(point);
  body.curve = std::move(curve);
}

bool same_solid(const Body& a, const Body& b)
{
  if (!a.solid || !b.solid) return !a.solid && !b.solid;
  return a.solid == b.solid || (a.solid->kind() == b.solid->kind() && a.solid->sizes() == b.solid->sizes());
}

int solid_probe_dimension(const Body& body) { return body.solid->probe_dimension(); }

Body make_body(const Primitive& primitive, int element, int index, double length)
{
  Body b;
  b.element = element;
  b.index = index;
  b.kind = primitive.kind;
  b.R = primitive.R() / length;
  b.r0 = primitive.r0() / length;
  b.r1 = primitive.r1() / length;
  b.center = primitive.position / length;
  b.axes = primitive.rotation;
  // Farthest surface point from the centre: |(R + r0 cos v, r1 sin v)| <= R + max(r0, r1).
  b.bound = b.R + std::max(b.r0, b.r1);
  if (b.kind == PrimitiveKind::curve_tube)
    set_core(b, std::make_shared<const ClosedCurve>(primitive.curve, 1.0 / length), b.r0);
  if (primitive.surface) {
    b.surface = primitive.surface;
    b.bound = b.R * b.surface->bound();
  }
  if (primitive.solid) {
    b.solid = primitive.solid;
    b.unit = length;
    b.bound = b.R;
  }
  b.reach = b.center.norm() + b.bound;
  return b;
}

}  // namespace hauberk
