#include "geometry/core.hpp"

#include <hauberk/solid.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk {

bool is_round(const Body& body)
{
  return body.solid ? body.solid->probe_dimension() == 1 : body.curve || body.is_circle_tube();
}

CurvePoint core_at(const Body& body, const Angle& u)
{
  if (body.curve) return body.curve->at(u);
  if (body.solid) {
    const ProbeDerivatives d = body.solid->probe({u.c, u.s, 1.0, 0.0});
    return {d.x / body.unit, d.u / body.unit, d.uu / body.unit};
  }
  const Vec3 radial(body.R * u.c, body.R * u.s, 0.0);
  return {radial, Vec3(-radial.y(), radial.x(), 0.0), -radial};
}

CoreBounds core_bounds(const Body& body)
{
  if (body.curve) return {body.curve->first(), body.curve->second()};
  if (body.solid) {
    const ProbeBounds b = body.solid->probe_bounds(0.0, 0.0, std::numbers::pi, 0.0);
    return {b.u / body.unit, b.uu / body.unit};
  }
  return {body.R, body.R};
}

int core_degree(const Body& body)
{
  if (body.curve) return static_cast<int>(body.curve->size());
  if (!body.solid) return 1;
  const ProbeBounds b = body.solid->probe_bounds(0.0, 0.0, std::numbers::pi, 0.0);
  return static_cast<int>(std::ceil(std::max(1.0, std::sqrt(b.uuu / b.u))));
}

}  // namespace hauberk
