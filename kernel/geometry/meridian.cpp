#include "geometry/meridian.hpp"

#include <Eigen/Core>

namespace hauberk {

namespace {

/// Newton steps shorter than this are the last: the error of the angle that is left is of their third order,
/// and distances know it to second order.
constexpr double last_step = 1e-5;
/// Ellipses flatter than this take as much shorter ones, as the third order grows.
constexpr double flat = 0.2;

double last_step_for(double a, double b)
{
  return last_step * std::min(1.0, std::min(a, b) / (flat * std::max(a, b)));
}

/// A first guess: exact for points on the ellipse, and to first order in their distance from it.
void first_guess(double a, double b, double px, double py, double& c, double& s)
{
  const double qx = px / a, qy = py / b, qq = qx * qx + qy * qy;
  if (!(qq > 0.0)) {
    c = b < a ? 0.0 : 1.0;
    s = b < a ? 1.0 : 0.0;
    return;
  }
  // The point is (c (a + d b), s (b + d a)), d its distance over the length w of the normal (b c, a s).
  const double gx = b * qx, gy = a * qy;
  const double d =
      std::max((std::sqrt(qq) - 1.0) * a * b * qq / (gx * gx + gy * gy), -0.5 * std::min(a / b, b / a));
  const double x = px * (b + d * a), y = py * (a + d * b), n = 1.0 / std::sqrt(x * x + y * y);
  c = x * n;
  s = y * n;
}

}  // namespace

MeridianDistance ellipse_distance(double a, double b, double x, double y)
{
  const double px = std::abs(x);
  const double py = std::abs(y);
  const double e = a * a - b * b;

  // Bracket [lo, hi] of the root as unit vectors.
  double lc = 1.0, ls = 0.0, hc = 0.0, hs = 1.0;
  double c = 1.0, s = 0.0;
  first_guess(a, b, px, py, c, s);
  constexpr int limit = 60;
  const double last = last_step_for(a, b);
  for (int it = 0; it < limit; ++it) {
    const double bend = e * c * s;
    const double f = bend - px * a * s + py * b * c;
    const double df = e * (c * c - s * s) - px * a * c - py * b * s;
    // On the axis, inside of the evolute, the end of the bracket is a root that is no closest point.
    if (f > 0.0 || (f == 0.0 && s == 0.0 && df > 0.0)) {
      lc = c;
      ls = s;
    } else {
      hc = c;
      hs = s;
    }
    // Halley's step m/n; df < 0 at the closest point, where that fails the bracket is bisected.
    const double ddf = -f - 3.0 * bend, m = -f * df, n = df * df - 0.5 * f * ddf;
    bool inside = df < 0.0 && std::abs(m) < n;
    double nc = 0.0, ns = 0.0;
    if (inside) {
      // Turned by 2 atan(m/2n), the step to third order, without a square root.
      const double nn = 4.0 * n * n, mm = m * m, r = 1.0 / (nn + mm);
      const double turn_c = (nn - mm) * r, turn_s = 4.0 * m * n * r;
      nc = turn_c * c - turn_s * s;
      ns = turn_c * s + turn_s * c;
      // Left of hi and right of lo (cross products of unit vectors).
      inside = lc * ns - ls * nc >= 0.0 && nc * hs - ns * hc >= 0.0;
    }
    if (!inside) {
      nc = lc + hc;
      ns = ls + hs;
      const double q = std::sqrt(nc * nc + ns * ns);
      nc /= q;
      ns /= q;
    }
    const bool done = inside ? std::abs(f) < -last * df : std::abs(nc - c) + std::abs(ns - s) < 4e-16;
    c = nc;
    s = ns;
    if (done) break;
  }

  MeridianDistance d;
  d.c = x < 0.0 ? -c : c;
  d.s = y < 0.0 ? -s : s;
  const double gx = d.c * b, gy = d.s * a;  // outward normal direction (c/a, s/b) times ab
  const double w = gx * gx + gy * gy, g = std::sqrt(w), r = 1.0 / g;
  d.nr = gx * r;
  d.nz = gy * r;
  d.phi = (x - a * d.c) * d.nr + (y - b * d.s) * d.nz;
  d.k = a * b / (w * g + a * b * d.phi);  // kappa/(1 + kappa phi), kappa = ab/g^3
  return d;
}

template <std::size_t count>
std::array<MeridianDistance, count> ellipse_distances(double a, double b, const std::array<double, count>& x,
                                                      const std::array<double, count>& y)
{
  using Several = Eigen::Array<double, static_cast<int>(count), 1>;
  const Several at_x = Eigen::Map<const Several>(x.data()), at_y = Eigen::Map<const Several>(y.data());
  // As for one point, without a bracket: in the first quadrant there is one root with df < 0.
  const double ab = a * b, e = a * a - b * b, least = -0.5 * std::min(a / b, b / a);
  const Several px = at_x.abs() * a, py = at_y.abs() * b;
  const Several qx = px / (a * a), qy = py / (b * b), qq = qx * qx + qy * qy, gx0 = b * qx, gy0 = a * qy;
  const Several d = ((qq.sqrt() - 1.0) * ab * qq / (gx0 * gx0 + gy0 * gy0)).max(least);
  Several c = qx * (b + d * a) * a, s = qy * (a + d * b) * b;
  const Several length = (c * c + s * s).sqrt().inverse();
  c *= length;
  s *= length;
  const double last = last_step_for(a, b);
  bool found = false;
  for (int it = 0; it < 4 && !found; ++it) {
    const Several bend = e * c * s, f = bend - px * s + py * c, df = e * (c * c - s * s) - px * c - py * s;
    const Several m = -f * df, n = df * df + 0.5 * f * (f + 3.0 * bend), nn = 4.0 * n * n, mm = m * m;
    const Several r = (nn + mm).inverse(), turn_c = (nn - mm) * r, turn_s = 4.0 * m * n * r;
    const Several nc = turn_c * c - turn_s * s, ns = turn_c * s + turn_s * c;
    c = nc;
    s = ns;
    // Not true where anything is not a number.
    constexpr double outside = -1e-15;
    found = (f.abs() < -last * df && c > outside && s > outside).all();
  }
  std::array<MeridianDistance, count> out;
  if (!found) {
    for (std::size_t k = 0; k < count; ++k) out[k] = ellipse_distance(a, b, x[k], y[k]);
    return out;
  }
  c = (at_x < 0.0).select(-c, c);
  s = (at_y < 0.0).select(-s, s);
  const Several gx = b * c, gy = a * s, w = gx * gx + gy * gy, g = w.sqrt(), r = g.inverse();
  const Several nr = gx * r, nz = gy * r, phi = (at_x - a * c) * nr + (at_y - b * s) * nz;
  const Several k = ab / (w * g + ab * phi);
  for (std::size_t i = 0; i < count; ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    out[i] = {phi[j], nr[j], nz[j], k[j], c[j], s[j]};
  }
  return out;
}

template std::array<MeridianDistance, 2> ellipse_distances(double, double, const std::array<double, 2>&,
                                                           const std::array<double, 2>&);
template std::array<MeridianDistance, 4> ellipse_distances(double, double, const std::array<double, 4>&,
                                                           const std::array<double, 4>&);

namespace {

/// Fields around an ellipse for at most `n` points; what is missing of them is a copy of the first.
template <std::size_t n>
void some_fields_at(const Body& body, std::span<const PointField> points)
{
  std::array<double, n> rho{}, x{}, z{};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = *points[i < points.size() ? i : 0].p;
    rho[i] = radius_of(p);
    x[i] = rho[i] - body.R;
    z[i] = p.z();
  }
  const std::array<MeridianDistance, n> found = ellipse_distances(body.r0, body.r1, x, z);
  for (std::size_t i = 0; i < points.size(); ++i)
    *points[i].f = field_from_meridian(found[i], rho[i], *points[i].p);
}

}  // namespace

void fields_at(const Body& body, std::span<const PointField> points)
{
  if (!body.is_ellipse()) {
    for (const PointField& at : points) *at.f = field_at(body, *at.p);
    return;
  }
  while (!points.empty()) {
    const std::size_t count = std::min<std::size_t>(4, points.size());
    const std::span<const PointField> some = points.first(count);
    if (count == 1)
      *some[0].f = field_at(body, *some[0].p);
    else if (count == 2)
      some_fields_at<2>(body, some);
    else
      some_fields_at<4>(body, some);
    points = points.subspan(count);
  }
}

FieldValue ball_field(double r0, const Vec3& p)
{
  FieldValue f;
  const double d = std::max(p.norm(), 1e-300);
  f.rho = d;
  f.n = p / d;
  f.meridian = f.n.unitOrthogonal();
  f.azimuth = f.n.cross(f.meridian);
  const double across = std::hypot(f.n.x(), f.n.y());
  f.m = {d - r0, across, f.n.z(), 1.0 / d, across, f.n.z()};
  f.k_azimuth = 1.0 / d;
  return f;
}

}  // namespace hauberk
