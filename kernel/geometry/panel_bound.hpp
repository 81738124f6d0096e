#pragma once
/// Lower bounds of the distance field over panels of probe points.

#include "geometry/pair_frame.hpp"

namespace hauberk {

/// Upper bounds of the second and third derivatives of a body's distance field along unit directions, over a
/// ball. Infinite where nothing is known (too near the axis, or to the medial axis inside).
struct FieldCurvature {
  double second, third;
};

/// The two bounds from those of the curvature k of level curves in the meridian half-plane and of its change
/// k_s along them, at distances of at least rho from the axis; see field_curvature().
inline FieldCurvature curvature_bounds(double k, double ks, double rho)
{
  constexpr double c = 1.1547005383792517;
  return {std::max(k, 1.0 / rho), ks + c * (k * k + k / rho + 1.0 / (rho * rho))};
}

/// The same of a solid, from what is known of its surface: where nothing is beyond its reach t, level
/// surfaces at the distance phi bend by k/(1 + k phi), at most 1/(t - phi) the concave way, and with the
/// change C of the surface's normal curvature along geodesics |D^3 phi| <= C/(1 + k phi)^3 + c k^2 (above).
FieldCurvature solid_curvature(const Body& F, const FieldValue& f, double d);

/// Bounds over all points within `d` of the point where `f` was evaluated.
///
/// In the meridian half-plane, with the normal n and the tangent t of the level curve, D^2 phi = k t t^T and
///   D^3 phi[w, w, w] = k_s (w.t)^3 - 3 k^2 (w.n)(w.t)^2,   k = kappa/(1 + kappa phi),
/// where kappa is the profile's curvature at the closest point and k_s = kappa_s/(1 + kappa phi)^3 its change
/// along the level curve. In space rho bends by w_theta^2/rho along a line and
///   |D^2 phi| <= max(k, 1/rho),   |D^3 phi| <= |k_s| + c (k^2 + k/rho + 1/rho^2),
/// c = 3 max |x| (1 - x^2) = 2/sqrt(3). Closest points move by at most d where the field is positive
/// (projection on a convex set), and by d/(1 + kappa phi) inside. On an ellipse (a, b) with w = |dx/dv|,
///   kappa = a b/w^3,  kappa_s = -3 a b w_s/w^4,  |w_s| = |a^2 - b^2| |cos v sin v|/w^2 <= |a^2 - b^2|/(2 a
///   b),
/// so that k_s = -3 a b w_s w^5/(w^3 + a b phi)^3. It falls with phi, and as a function of w alone it is
/// largest where w^3 = 5/4 a b phi: far from a sharp edge the field is smoother than the edge.
inline FieldCurvature field_curvature(const Body& F, const FieldValue& f, double d)
{
  if (!F.is_torus() && F.solid) return solid_curvature(F, f, d);
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const double rho = f.rho - d;
  if (!(rho > 0.0)) return {unknown, unknown};
  double k = 0.0, ks = 0.0;
  if (F.kind == PrimitiveKind::circle_tube) {
    const double to_core = f.m.phi + F.r0 - d;
    if (!(to_core > 0.0)) return {unknown, unknown};
    k = 1.0 / to_core;
  } else {
    constexpr double deepest = 0.5;  // least 1 + kappa phi
    const double a = F.r0, b = F.r1, e = std::abs(a * a - b * b);
    const double inside = std::max(0.0, d - f.m.phi);
    const double arc = d / (inside > 0.0 ? deepest : 1.0);
    const double w0 = std::hypot(a * f.m.s, b * f.m.c);
    const double w = std::max(std::min(a, b), w0 - arc * e / (2.0 * a * b));
    const double kappa = a * b / (w * w * w);
    const double beta = 1.0 - kappa * inside;
    if (inside > 0.0 && beta < deepest) return {unknown, unknown};
    const double ws = std::min(e / (2.0 * a * b), e * (std::abs(f.m.c * f.m.s) + arc / w) / (w * w));
    const double outside = a * b * std::max(0.0, f.m.phi - d);
    k = kappa / (beta + kappa * outside / (a * b));
    const double cube = w * w * w, wide = cube >= 1.25 * outside ? w : std::cbrt(1.25 * outside);
    const double sum = beta * (wide * wide * wide + outside);  // beta = 1 where outside > 0
    ks = 3.0 * a * b * ws * (wide * wide) * (wide * wide * wide) / (sum * sum * sum);
  }
  return curvature_bounds(k, ks, rho);
}

/// A field that is nowhere larger than F's, equal to it in value and slope where `f` was evaluated, and
/// smoother: the distance from a disc that holds all of the profile and touches it at the closest point. A
/// disc as wide as the profile's largest radius of curvature does (Blaschke's rolling theorem). Its curvature
/// is 1/(radius + phi) everywhere, so that panels far from contact may be large where F's own sharp edges
/// would make them small. For circle tubes it is F's field itself.
struct RolledField {
  FieldValue f;
  double radius;

  RolledField(const Body& F, const FieldValue& value)
      : f(value), radius(std::max(F.r0 * F.r0 / F.r1, F.r1 * F.r1 / F.r0))
  {
    f.m.k = 1.0 / (radius + f.m.phi);
  }

  /// Bounds over all points within `d`, as field_curvature().
  FieldCurvature curvature(double d) const
  {
    const double to_core = f.m.phi + radius - d, rho = f.rho - d;
    if (!(to_core > 0.0 && rho > 0.0))
      return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    return curvature_bounds(1.0 / to_core, 0.0, rho);
  }
};

/// Smallest value of slope x + second x^2/2 over |x| <= h.
inline double least_on_line(double slope, double second, double h)
{
  const double g = std::abs(slope);
  if (second * h > g) return -0.5 * g * g / second;
  return (0.5 * second * h - g) * h;
}

/// A function of two coordinates to second order about a point, without its value there.
struct Quadratic {
  double u = 0.0, v = 0.0;              ///< first derivatives
  double uu = 0.0, uv = 0.0, vv = 0.0;  ///< second derivatives
};

/// Smallest value of u a + v b + 1/2 (uu a^2 + 2 uv a b + vv b^2) over |a| <= hu, |b| <= hv, never positive:
/// inside where the form is convex and its minimum lies there, on the border otherwise.
inline double least_over_box(const Quadratic& q, double hu, double hv)
{
  const double det = q.uu * q.vv - q.uv * q.uv;
  if (det > 0.0 && q.uu > 0.0) {
    const double a = q.uv * q.v - q.vv * q.u, b = q.uv * q.u - q.uu * q.v;  // times det
    if (std::abs(a) <= hu * det && std::abs(b) <= hv * det) return 0.5 * (q.u * a + q.v * b) / det;
  }
  const auto edge = [](double at, double along, double first, double second, double mixed, double across,
                       double reach) {
    return first * at + 0.5 * second * at * at + least_on_line(along + mixed * at, across, reach);
  };
  return std::min({0.0, edge(hu, q.v, q.u, q.uu, q.uv, q.vv, hv), edge(-hu, q.v, q.u, q.uu, q.uv, q.vv, hv),
                   edge(hv, q.u, q.v, q.vv, q.uv, q.uu, hu), edge(-hv, q.u, q.v, q.vv, q.uv, q.uu, hu)});
}

/// Largest displacement on a panel, and how far paths on it bend: bounds of |p'|, |p''| and |p^(3)| along a
/// straight line from its centre.
struct PanelSize {
  double first, second, third;
};

/// Of a part of a solid's probe.
PanelSize solid_panel_size(const Body& P, const Panel& s);

template <int dim>
PanelSize panel_size(const Probe<dim>& probe, const Panel& s)
{
  if (!probe.f.P->is_torus() && probe.f.P->solid) return solid_panel_size(*probe.f.P, s);
  PanelSize r{probe.Lu * s.hu, probe.Luu * s.hu * s.hu, probe.Luuu * s.hu * s.hu * s.hu};
  if constexpr (dim == 2) {
    r.first += probe.Lv * s.hv;
    r.second += probe.Lvv * s.hv * s.hv + 2.0 * probe.Luv * s.hu * s.hv;
    r.third += probe.Lvvv * s.hv * s.hv * s.hv + 3.0 * probe.Luv * s.hu * s.hv * (s.hu + s.hv);
  }
  return r;
}

/// Lower bound of the field over a panel from value and gradient at its centre. The signed distance of a body
/// whose profile is convex is a convex function of (rho, z), inside as well as outside, and its slope in rho
/// is at most 1; rho itself curves by at most 1/rho along a line. So the Hessian of the field is nowhere
/// below -1/rho (rho: distance from the body's axis), and with |p'| <= d on the panel
///   phi >= phi_mid - |phi_u| hu - |phi_v| hv - 1/2 (d^2/rho_min + |p''|),   rho_min = rho_mid - d,
/// and in any case phi >= phi_mid - d (Lipschitz constant 1).
template <int dim>
double taylor_bound(const Probe<dim>& probe, const Panel& s, double phi, double rho, double gu, double gv)
{
  const PanelSize size = panel_size(probe, s);
  const double rho_min = rho - size.first;
  if (!(rho_min > 0.0)) return phi - size.first;
  const double slope = std::abs(gu) * s.hu + std::abs(gv) * s.hv;
  return phi - std::min(size.first, slope + 0.5 * (size.first * size.first / rho_min + size.second));
}

/// D^2 phi[x], the change of the gradient along x, at the point where `f` was evaluated.
inline Vec3 field_hessian(const FieldValue& f, const Vec3& x)
{
  return (f.m.k * f.meridian.dot(x)) * f.meridian + (f.k_azimuth * f.azimuth.dot(x)) * f.azimuth;
}

/// D^2 phi[x, y].
inline double field_hessian(const FieldValue& f, const Vec3& x, const Vec3& y)
{
  return f.m.k * f.meridian.dot(x) * f.meridian.dot(y) + f.k_azimuth * f.azimuth.dot(x) * f.azimuth.dot(y);
}

/// Second derivatives of the field along the probe set, D^2 phi[p_i, p_j] + n . p_ij; only uu in dimension 1.
template <int dim>
SecondDerivatives surface_hessian(const Probe<dim>& probe, const ProbePoint& q, const FieldValue& f)
{
  SecondDerivatives h = probe.second(q, f.n);
  h.uu += field_hessian(f, q.pu, q.pu);
  if constexpr (dim == 2) {
    h.uv += field_hessian(f, q.pu, q.pv);
    h.vv += field_hessian(f, q.pv, q.pv);
  }
  return h;
}

/// Least sum of the terms of first and second order over a panel: phi >= phi_mid + least - (third order),
/// with the second derivatives H = D^2 phi[p_i, p_j] + n . p_ij. Taken together: near a minimum what the
/// slope takes away the curvature gives back, so that a panel with a minimum at its border loses no more than
/// one with it at its centre.
template <int dim>
double least_to_second_order(const Probe<dim>& probe, const Panel& s, const ProbePoint& q,
                             const FieldValue& f)
{
  const SecondDerivatives h = surface_hessian(probe, q, f);
  const double gu = f.n.dot(q.pu);
  if constexpr (dim == 1) return std::min(0.0, least_on_line(gu, h.uu, s.hu));
  return least_over_box({gu, f.n.dot(q.pv), h.uu, h.uv, h.vv}, s.hu, s.hv);
}

/// A sixth of the largest third derivative of the field along a path with these bounds of its derivatives.
inline double third_order(const FieldCurvature& field, const PanelSize& path)
{
  const double d = path.first;
  return (field.third * d * d * d + 3.0 * field.second * d * path.second + path.third) / 6.0;
}

/// As `taylor_bound`, from the second derivatives at the centre too, where the field is known as `field`
/// within the panel's size. Surfaces that conform have nearly no H, so that only the third order is left, and
/// panels may be as large as the third root of the gap instead of its square root.
template <int dim>
double curved_bound(const Probe<dim>& probe, const Panel& s, const ProbePoint& q, const FieldValue& f,
                    const FieldCurvature& field)
{
  return f.m.phi + least_to_second_order(probe, s, q, f) - third_order(field, panel_size(probe, s));
}

/// The field as if its level surfaces were flat. With rho_min as in taylor_bound(),
///   phi(x) >= phi_mid + n . (x - x_mid) - |x - x_mid|^2/(2 rho_min),
/// whatever else is known of its curvature, so what paths do to n . (x - x_mid) may be expanded exactly. Of a
/// convex solid nothing is lost where curvature jumps.
inline FieldValue flattened(const FieldValue& f)
{
  FieldValue flat = f;
  flat.m.k = flat.k_azimuth = 0.0;
  return flat;
}
inline constexpr FieldCurvature flat_curvature{0.0, 0.0};

/// What is known of the field over a panel.
struct PanelBound {
  double value = 0.0;  ///< phi at the centre
  double bound = 0.0;  ///< phi over the panel is not smaller
};

/// Lower bound of the field over a panel, from the field `f` at its centre `q`. The dearer ones are only
/// tried where they can reach `needed`.
template <int dim>
PanelBound panel_bound(const Probe<dim>& probe, const Panel& s, const ProbePoint& q, const FieldValue& f,
                       double needed)
{
  const double gu = f.n.dot(q.pu), gv = dim == 2 ? f.n.dot(q.pv) : 0.0;
  PanelBound r{f.m.phi, taylor_bound(probe, s, f.m.phi, f.rho, gu, gv) - f.doubt};
  if (r.bound >= needed || f.m.phi < needed) return r;
  const double d = panel_size(probe, s).first;
  const auto raise = [&](const FieldValue& at, const FieldCurvature& field) {
    if (field.third < std::numeric_limits<double>::infinity())
      r.bound = std::max(r.bound, curved_bound(probe, s, q, at, field));
  };
  if (!probe.f.F->is_torus() && f.rho > d) {
    const double bent = 0.5 * d * d / (f.rho - d);
    r.bound = std::max(r.bound, curved_bound(probe, s, q, flattened(f), flat_curvature) - bent - f.doubt);
    if (r.bound >= needed) return r;
  }
  if (probe.f.F->is_ellipse()) {
    const RolledField rolled(*probe.f.F, f);
    raise(rolled.f, rolled.curvature(d));
    if (r.bound >= needed) return r;
  }
  raise(f, field_curvature(*probe.f.F, f, d));
  return r;
}

}  // namespace hauberk
