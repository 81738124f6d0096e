#include <hauberk/geometry/body.hpp>
#include <hauberk/geometry/closed_curve.hpp>
#include <hauberk/geometry/triangle_surface.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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
  b.reach = b.center.norm() + b.bound;
  return b;
}

double characteristic_length(const SceneSpec& spec)
{
  if (spec.length > 0.0) return spec.length;
  std::vector<double> radii;
  for (const PlacedElement& e : spec.elements) {
    for (const Primitive& p : spec.types[static_cast<std::size_t>(e.type)].shape->primitives(e.parameters)) {
      radii.push_back(p.R());
    }
  }
  if (radii.empty()) return 1.0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

double thinnest_tube(const SceneSpec& spec)
{
  double thinnest = std::numeric_limits<double>::infinity();
  for (const PlacedElement& e : spec.elements) {
    for (const Primitive& p : spec.types[static_cast<std::size_t>(e.type)].shape->primitives(e.parameters))
      thinnest = std::min({thinnest, p.r0(), p.r1()});
  }
  return thinnest;
}

}  // namespace hauberk
