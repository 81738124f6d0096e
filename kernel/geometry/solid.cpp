#include <hauberk/solid.hpp>

#include "geometry/panel_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// How fast the direction of a line turns, by bounds of its derivatives: as of a curve, or where third ones
/// jump by the second.
double turning(double first, double second, double third)
{
  return std::isfinite(third) ? std::sqrt(third / first) : second / first;
}

}  // namespace

FieldValue solid_field(const Body& body, const Vec3& p)
{
  const SolidDistance at = body.solid->distance(body.unit * p);
  FieldValue f;
  f.m.phi = at.distance / body.unit;
  f.doubt = (at.distance - at.at_least) / body.unit;
  f.n = at.normal;
  f.meridian = at.along;
  f.azimuth = at.normal.cross(at.along);
  f.m.k = at.bend_along * body.unit;
  f.k_azimuth = at.bend_across * body.unit;
  // Level surfaces bend the concave way by 1/(reach - phi) at most; where the foot may not be the nearest
  // point, by anything.
  f.rho = f.doubt > 0.0 ? -1.0 : body.solid->smoothness().reach / body.unit - f.m.phi;
  return f;
}

FieldCurvature solid_curvature(const Body& F, const FieldValue& f, double d)
{
  constexpr double deepest = 0.5;  // least 1 + k phi
  const SolidSmoothness s = F.solid->smoothness();
  const double convex = s.convex * F.unit, left = f.rho - d;
  const double inside = convex * std::min(0.0, f.m.phi - d);  // of 1 + k phi
  if (f.doubt > 0.0 || !(left > 0.0) || 1.0 + inside < deepest) return {unknown, unknown};
  const double concave = 1.0 / left;
  const double k = std::max(convex / (1.0 + convex * (f.m.phi - d)), concave);
  const double reach = s.reach / F.unit;
  const double grown = std::max(1.0 / (1.0 + inside), std::isfinite(reach) ? reach * concave : 1.0);
  constexpr double c = 1.1547005383792517;
  return {k, s.change * F.unit * F.unit * grown * grown * grown + c * k * k};
}

PanelSize solid_panel_size(const Body& P, const Panel& s)
{
  const ProbeBounds b = P.solid->probe_bounds(s.u, s.v, s.hu, s.hv);
  const double u = s.hu, v = s.hv;
  const double first = b.u * u + b.v * v;
  const double second = b.uu * u * u + 2.0 * b.uv * u * v + b.vv * v * v;
  const double third =
      b.uuu * u * u * u + 3.0 * b.uuv * u * u * v + 3.0 * b.uvv * u * v * v + b.vvv * v * v * v;
  return {first / P.unit, second / P.unit, third / P.unit};
}

template <int dim>
void Probe<dim>::set_bounds()
{
  const Body& P = *f.P;
  const ProbeBounds b = P.solid->probe_bounds(0.0, 0.0, std::numbers::pi, dim == 2 ? std::numbers::pi : 0.0);
  Lu = b.u / P.unit;
  Luu = b.uu / P.unit;
  Luuu = b.uuu / P.unit;
  Lv = b.v / P.unit;
  Lvv = b.vv / P.unit;
  Lvvv = b.vvv / P.unit;
  Luv = std::max({b.uv, b.uuv, b.uvv}) / P.unit;
  offset = P.solid->offset() / P.unit;
  frequency = std::max(1.0, turning(Lu, Luu, Luuu));
  if (dim == 2) frequency = std::max(frequency, turning(Lv, Lvv, Lvvv));
}

template <int dim>
void Probe<dim>::locate_on_solid(const Angle& u, const Angle& v, ProbePoint& q) const
{
  const Body& P = *f.P;
  const ProbeDerivatives d = P.solid->probe({u.c, u.s, v.c, v.s});
  const double scale = 1.0 / P.unit;
  const auto turned = [&](const Vec3& x) -> Vec3 {
    return (scale * x[0]) * f.e1 + (scale * x[1]) * f.e2 + (scale * x[2]) * f.e3;
  };
  q.p = f.a + turned(d.x);
  q.pu = turned(d.u);
  q.pv = turned(d.v);
  q.radial.setZero();
  q.pvv.setZero();
  q.on_p = q.p;
  q.u = u;
  q.v = v;
}

template <int dim>
SecondDerivatives Probe<dim>::solid_second(const ProbePoint& q, const Vec3& n) const
{
  const Body& P = *f.P;
  const ProbeDerivatives d = P.solid->probe({q.u.c, q.u.s, q.v.c, q.v.s});
  const Vec3 local = Vec3(n.dot(f.e1), n.dot(f.e2), n.dot(f.e3)) / P.unit;
  return {local.dot(d.uu), local.dot(d.uv), local.dot(d.vv)};
}

template void Probe<1>::set_bounds();
template void Probe<2>::set_bounds();
template void Probe<1>::locate_on_solid(const Angle&, const Angle&, ProbePoint&) const;
template void Probe<2>::locate_on_solid(const Angle&, const Angle&, ProbePoint&) const;
template SecondDerivatives Probe<1>::solid_second(const ProbePoint&, const Vec3&) const;
template SecondDerivatives Probe<2>::solid_second(const ProbePoint&, const Vec3&) const;

}  // namespace hauberk
