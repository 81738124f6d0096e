#include "minima.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace hauberk::brute {
namespace {

using std::numbers::pi;

double turn(double angle) { return std::remainder(angle, 2.0 * pi); }

double u_scale(const Torus& P) { return P.R + (P.round() ? 0.0 : P.r0); }
double v_scale(const Torus& P) { return std::max(P.r0, P.r1); }

/// Root of the slope between lo and hi, where it rises from negative to positive.
double slope_root(const Field& f, double lo, double hi)
{
  double g, unused;
  for (int k = 0; k < 200 && hi - lo > 1e-15; ++k) {
    const double mid = 0.5 * (lo + hi);
    f.value(mid, 0.0, g, unused);
    (g < 0.0 ? lo : hi) = mid;
  }
  return 0.5 * (lo + hi);
}

struct Hessian {
  double uu, uv, vv;  // in arc lengths
};

Hessian hessian(const Field& f, double u, double v)
{
  const double su = u_scale(f.P), sv = v_scale(f.P), h = 1e-5;
  double a, b, c, d;
  Hessian H{};
  f.value(u + h, v, a, b);
  f.value(u - h, v, c, d);
  H.uu = (a - c) / (2.0 * h * su * su);
  H.uv = (b - d) / (2.0 * h * su * sv);
  f.value(u, v + h, a, b);
  f.value(u, v - h, c, d);
  H.vv = (b - d) / (2.0 * h * sv * sv);
  H.uv = 0.5 * (H.uv + (a - c) / (2.0 * h * su * sv));
  return H;
}

double lowest(const Hessian& H) { return 0.5 * (H.uu + H.vv) - std::hypot(0.5 * (H.uu - H.vv), H.uv); }

/// A place a little way along the direction of lowest curvature, where that is lower than the saddle (u, v).
std::optional<std::pair<double, double>> off_saddle(const Field& f, double u, double v, double value,
                                                    const Hessian& H)
{
  constexpr double flat = 1e-7;  // second differences resolve no less
  if (lowest(H) > -flat) return std::nullopt;
  const double half = 0.5 * (H.uu - H.vv), spread = std::hypot(half, H.uv);
  const double x = half > 0.0 ? -H.uv : half - spread, y = half > 0.0 ? half + spread : H.uv;
  const double length = std::hypot(x, y);
  if (length == 0.0) return std::nullopt;
  for (double step = 1e-2 * f.P.R; step > 1e-6 * f.P.R; step *= 0.25) {
    const double nu = u + step * x / length / u_scale(f.P), nv = v + step * y / length / v_scale(f.P);
    if (f.value(nu, nv) < value) return std::pair{nu, nv};
  }
  return std::nullopt;
}

/// Damped Newton descent on a surface. Symmetric pairs have saddles exactly on samples, with minima on both
/// sides that may be less than 1e-8 lower: saddles are left, not taken for what is closest.
BruteMinimum descend(const Field& f, double u, double v)
{
  const double su = u_scale(f.P), sv = v_scale(f.P);
  double gu, gv, value = f.value(u, v, gu, gv);
  for (int k = 0; k < 200; ++k) {
    const double x = gu / su, y = gv / sv, size = std::hypot(x, y);
    const Hessian H = hessian(f, u, v);
    if (size < 1e-13) {
      const auto lower = off_saddle(f, u, v, value, H);
      if (!lower) break;
      std::tie(u, v) = *lower;
      value = f.value(u, v, gu, gv);
      continue;
    }
    // Along negative curvature the Newton step is turned round, so that level valleys are left quickly.
    const double low = lowest(H), shift = low < 1e-9 ? 1e-8 - 2.0 * std::min(low, 0.0) : 0.0;
    const double a = H.uu + shift, c = H.vv + shift, det = a * c - H.uv * H.uv;
    double dx = -(c * x - H.uv * y) / det, dy = -(a * y - H.uv * x) / det;
    const double longest = 0.05 * std::min(f.P.R, f.F.R), length = std::hypot(dx, dy);
    if (length > longest) {
      dx *= longest / length;
      dy *= longest / length;
    }
    bool moved = false;
    double t = 1.0;
    for (int halvings = 0; halvings < 20; ++halvings, t *= 0.5) {
      double nu, nv;
      const double next = f.value(u + t * dx / su, v + t * dy / sv, nu, nv);
      // Close to the minimum values are equal to rounding and the slope decides.
      if (next < value || (next < value + 1e-14 && std::hypot(nu / su, nv / sv) < 0.9 * size)) {
        u += t * dx / su;
        v += t * dy / sv;
        value = next;
        gu = nu;
        gv = nv;
        moved = true;
        break;
      }
    }
    if (!moved) break;
  }
  return {u, v, value};
}

void insert(std::vector<BruteMinimum>& list, const Torus& P, const BruteMinimum& m)
{
  for (const BruteMinimum& o : list) {
    if (std::hypot(turn(o.u - m.u) * u_scale(P), turn(o.v - m.v) * v_scale(P)) < 1e-6) return;
  }
  list.push_back(m);
}

void search_curve(const Field& f, int n, std::vector<BruteMinimum>& out)
{
  std::vector<double> value(n);
  for (int k = 0; k < n; ++k) value[k] = f.value(2.0 * pi * k / n, 0.0);
  const auto at = [&](int k) { return value[(k + n) % n]; };
  for (int k = 0; k < n; ++k) {
    if (!(at(k) <= at(k - 1) && at(k) < at(k + 1))) continue;
    const double u = slope_root(f, 2.0 * pi * (k - 1) / n, 2.0 * pi * (k + 1) / n);
    insert(out, f.P, {u, 0.0, f.value(u, 0.0)});
  }
  if (out.empty()) {  // constant along the curve
    const auto lowest_sample = std::min_element(value.begin(), value.end());
    out.push_back({2.0 * pi * static_cast<double>(lowest_sample - value.begin()) / n, 0.0, *lowest_sample});
  }
}

void search_surface(const Field& f, int nu, int nv, std::vector<BruteMinimum>& out)
{
  std::vector<double> value(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv));
  const auto at = [&](int i, int j) -> double& {
    return value[static_cast<std::size_t>((i + nu) % nu) * static_cast<std::size_t>(nv) +
                 static_cast<std::size_t>((j + nv) % nv)];
  };
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) at(i, j) = f.value(2.0 * pi * i / nu, 2.0 * pi * j / nv);
  }
  const auto k = std::min_element(value.begin(), value.end()) - value.begin();
  const auto row = k / nv, column = k % nv;
  BruteMinimum deepest{2.0 * pi * static_cast<double>(row) / nu, 2.0 * pi * static_cast<double>(column) / nv,
                       value[k]};
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      bool low = true;
      for (int a = -1; a <= 1 && low; ++a) {
        for (int b = -1; b <= 1 && low; ++b) low = at(i + a, j + b) >= at(i, j);
      }
      if (!low) continue;
      const BruteMinimum m = descend(f, 2.0 * pi * i / nu, 2.0 * pi * j / nv);
      if (m.distance < deepest.distance) deepest = m;
      if (lowest(hessian(f, m.u, m.v)) > -1e-6) insert(out, f.P, m);
    }
  }
  // The deepest place counts even if descent did not arrive: inside F distances have ridges.
  insert(out, f.P, deepest);
}

/// Rise above `from` on the way of du, v settling at every u; v starts and ends in `w`.
double walk_valley(const Field& f, const BruteMinimum& from, double du, double& w)
{
  constexpr int steps = 64;
  double valley = from.distance;
  for (int k = 1; k <= steps; ++k) {
    const double x = from.u + du * k / steps;
    for (int it = 0; it < 30 && !f.curve(); ++it) {
      double gu, gv;
      const double value = f.value(x, w, gu, gv);
      const double curvature =
          std::max(hessian(f, x, w).vv * v_scale(f.P) * v_scale(f.P), 1e-3 * v_scale(f.P));
      double step = std::clamp(-gv / curvature, -0.1, 0.1);
      while (std::abs(step) > 1e-12 && f.value(x, w + step) > value) step *= 0.5;
      w += step;
      if (std::abs(step) < 1e-9) break;
    }
    valley = std::max(valley, f.value(x, w));
  }
  return valley - from.distance;
}

}  // namespace

double Field::value(double u, double v) const
{
  return curve() ? foot(F, P.core(u)).distance - P.r0 : foot(F, P.surface(u, v)).distance;
}

double Field::value(double u, double v, double& gu, double& gv) const
{
  const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v);
  const Vec3 along = -su * P.axes.col(0) + cu * P.axes.col(1);
  if (curve()) {
    const Foot f = foot(F, P.core(u));
    gu = P.R * f.normal.dot(along);
    gv = 0.0;
    return f.distance - P.r0;
  }
  const Vec3 out = cu * P.axes.col(0) + su * P.axes.col(1);
  const Foot f = foot(F, P.surface(u, v));
  gu = (P.R + P.r0 * cv) * f.normal.dot(along);
  gv = f.normal.dot(-P.r0 * sv * out + P.r1 * cv * P.axes.col(2));
  return f.distance;
}

std::vector<BruteMinimum> all_minima(const Torus& P, const Torus& F, const Sampling& sampling)
{
  std::vector<BruteMinimum> out;
  const Field f{P, F};
  const double ratio = std::clamp(P.R / F.R, 1.0, 8.0);
  if (P.round()) {
    search_curve(f, static_cast<int>(sampling.curve * std::sqrt(ratio)), out);
  } else {
    search_surface(f, static_cast<int>(sampling.around * ratio), sampling.across, out);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return out;
}

double surface_distance(const Torus& a, const Torus& b, const Sampling& sampling)
{
  const bool probe_a = a.round() != b.round() ? a.round() : a.R <= b.R;
  return (probe_a ? all_minima(a, b, sampling) : all_minima(b, a, sampling)).front().distance;
}

double solid_distance(const Torus& a, const Torus& b)
{
  return std::min(all_minima(a, b).front().distance, all_minima(b, a).front().distance);
}

double climb(const Field& f, const BruteMinimum& from, double u, double v)
{
  constexpr int steps = 64;
  const double du = turn(u - from.u), dv = turn(v - from.v);
  double straight = from.distance;
  for (int k = 1; k < steps; ++k) {
    const double s = static_cast<double>(k) / steps;
    straight = std::max(straight, f.value(from.u + s * du, from.v + s * dv));
  }
  if (f.curve() || straight - from.distance < 1e-10) return straight - from.distance;
  double w = from.v;
  const double valley = walk_valley(f, from, du, w);
  if (std::abs(turn(w - v)) > 1e-3) return straight - from.distance;  // the valley leads elsewhere
  return std::min(straight - from.distance, valley);
}

double rise_along_valley(const Field& f, const BruteMinimum& from, double reach)
{
  double w = from.v, x = from.v;
  return std::min(walk_valley(f, from, reach, w), walk_valley(f, from, -reach, x));
}

double lowest_curvature(const Field& f, double u, double v)
{
  if (!f.curve()) return lowest(hessian(f, u, v));
  double a, c, unused;
  const double h = 1e-5;
  f.value(u + h, 0.0, a, unused);
  f.value(u - h, 0.0, c, unused);
  return (a - c) / (2.0 * h * f.P.R * f.P.R);
}

}  // namespace hauberk::brute
