#include <hauberk/geometry/meridian.hpp>

namespace hauberk {

namespace {

/// Steps shorter than this are the last: the error that is left is of their third order.
constexpr double last_step = 2e-6;

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
  for (int it = 0; it < limit; ++it) {
    const double bend = e * c * s;
    const double f = bend - px * a * s + py * b * c;
    const double df = e * (c * c - s * s) - px * a * c - py * b * s;
    if (f > 0.0) {
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
    const bool done = inside ? std::abs(m) < last_step * n : std::abs(nc - c) + std::abs(ns - s) < 4e-16;
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
