#include <hauberk/geometry/meridian.hpp>

namespace hauberk {

MeridianDistance ellipse_distance(double a, double b, double x, double y)
{
  const double px = std::abs(x);
  const double py = std::abs(y);
  const double e = a * a - b * b;

  // Bracket [lo, hi] of the root as unit vectors; start from the direction that is exact for a circle and
  // good for points far away.
  double lc = 1.0, ls = 0.0, hc = 0.0, hs = 1.0;
  double c = px * a, s = py * b;
  {
    const double q = std::hypot(c, s);
    if (q > 0.0) {
      c /= q;
      s /= q;
    } else {
      c = b < a ? 0.0 : 1.0;
      s = b < a ? 1.0 : 0.0;
    }
  }
  constexpr int limit = 60;
  for (int it = 0; it < limit; ++it) {
    const double f = e * c * s - px * a * s + py * b * c;
    const double df = e * (c * c - s * s) - px * a * c - py * b * s;
    if (f > 0.0) {
      lc = c;
      ls = s;
    } else {
      hc = c;
      hs = s;
    }
    double step = df < 0.0 ? -f / df : 2.0;  // df < 0 at the closest point; 2 forces bisection
    double nc = c - step * s, ns = s + step * c;
    // Inside the bracket: left of hi and right of lo (cross products of unit vectors).
    const bool inside = std::abs(step) < 1.0 && lc * ns - ls * nc >= 0.0 && nc * hs - ns * hc >= 0.0;
    if (!inside) {
      nc = lc + hc;
      ns = ls + hs;
      step = 1.0;
    }
    const double q = std::sqrt(nc * nc + ns * ns);
    nc /= q;
    ns /= q;
    const bool done = std::abs(nc - c) + std::abs(ns - s) < 4e-16 || (inside && std::abs(step) < 1e-9);
    c = nc;
    s = ns;
    if (done) break;
  }

  MeridianDistance d;
  d.c = x < 0.0 ? -c : c;
  d.s = y < 0.0 ? -s : s;
  const double gx = d.c * b, gy = d.s * a;  // outward normal direction (c/a, s/b) times ab
  const double g = std::sqrt(gx * gx + gy * gy);
  d.nr = gx / g;
  d.nz = gy / g;
  d.phi = (x - a * d.c) * d.nr + (y - b * d.s) * d.nz;
  const double w = a * a * d.s * d.s + b * b * d.c * d.c;
  const double kappa = a * b / (w * std::sqrt(w));
  d.k = kappa / (1.0 + kappa * d.phi);
  return d;
}

}  // namespace hauberk
