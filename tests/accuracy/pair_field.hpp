#pragma once
/// Distance from the points of one torus to another with first and second derivatives, for any number type:
/// the same formulas in double and in multiprecision. Nothing here calls the kernel.

#include "torus.hpp"

#include <array>
#include <cmath>

namespace hauberk::brute {

template <typename S>
using Point = std::array<S, 3>;

template <typename S>
S dot(const Point<S>& a, const Point<S>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Signed distance to a plane ellipse with semi-axes (a, b), its unit normal and curvature there.
template <typename S>
struct Profile {
  S distance, nx, nz, kappa;
};

/// Closest point (a^2 X/(t + a^2), b^2 Z/(t + b^2)): t is the largest root of
/// (a X/(t + a^2))^2 + (b Z/(t + b^2))^2 = 1, reached by Newton's method from its left, where the left side
/// is convex and falls. Points inside, beyond the medial axis: some closest normal, never a larger distance.
template <typename S>
Profile<S> profile_distance(const S& a, const S& b, const S& X, const S& Z)
{
  using std::abs;
  using std::sqrt;
  const S aa = a * a, bb = b * b, x = abs(X), z = abs(Z);
  S t = std::max<S>(a * x - aa, b * z - bb);
  for (int k = 0; k < 200; ++k) {
    const S f = 1 / (t + aa), g = 1 / (t + bb), p = a * x * f, q = b * z * g;
    const S next = t + (p * p + q * q - 1) / (2 * (p * p * f + q * q * g));
    if (!(next > t)) break;  // monotone until rounding
    t = next;
  }
  const S c = a * x / (t + aa), s = b * z / (t + bb);  // cos v, sin v
  const S gx = b * c, gz = a * s, g = sqrt(gx * gx + gz * gz), w2 = aa * s * s + bb * c * c;
  Profile<S> out;
  out.nx = gx / g;
  out.nz = gz / g;
  out.distance = (x - a * c) * out.nx + (z - b * s) * out.nz;
  out.kappa = a * b / (w2 * sqrt(w2));
  if (X < 0) out.nx = -out.nx;
  if (Z < 0) out.nz = -out.nz;
  return out;
}

/// Value, gradient and Hessian in (u, v).
template <typename S>
struct FieldJet {
  S value, gu, gv, huu, huv, hvv;
};

/// Points of P in the distance field of F. P's core circle, less P's radius, where `core` (P round); else its
/// surface. The axes, unit to rounding as doubles, are made so in S.
template <typename S>
class PairField {
 public:
  PairField(const Torus& P, const Torus& F, bool core)
      : core_(core), round_(F.round()), R_(P.R), r0_(P.r0), r1_(P.r1), FR_(F.R), f0_(F.r0), f1_(F.r1)
  {
    const std::array<Point<S>, 3> f = unit_axes(F), p = unit_axes(P);
    Point<S> shift;
    for (std::size_t i = 0; i < 3; ++i) shift[i] = S(P.center[i]) - S(F.center[i]);
    for (std::size_t i = 0; i < 3; ++i) {
      a_[i] = dot(f[i], shift);
      e1_[i] = dot(f[i], p[0]);
      e2_[i] = dot(f[i], p[1]);
      e3_[i] = dot(f[i], p[2]);
    }
  }

  bool core() const { return core_; }
  /// Lengths that make (u, v) arc lengths at most.
  S around() const { return core_ ? R_ : S(R_ + r0_); }
  S across() const { return std::max<S>(r0_, r1_); }

  FieldJet<S> at(const S& u, const S& v) const
  {
    using std::cos;
    using std::sin;
    const S cu = cos(u), su = sin(u), cv = core_ ? S(0) : S(cos(v)), sv = core_ ? S(0) : S(sin(v));
    const S w = core_ ? R_ : S(R_ + r0_ * cv);
    Point<S> radial, tangent, pv, x;
    for (std::size_t i = 0; i < 3; ++i) {
      radial[i] = cu * e1_[i] + su * e2_[i];
      tangent[i] = cu * e2_[i] - su * e1_[i];
      pv[i] = core_ ? S(0) : S(r1_ * cv * e3_[i] - r0_ * sv * radial[i]);
      x[i] = a_[i] + w * radial[i] + (core_ ? S(0) : S(r1_ * sv * e3_[i]));
    }
    const Field f = field(x);
    FieldJet<S> j;
    j.value = core_ ? S(f.value - r0_) : f.value;
    const S nr = dot(f.n, radial), nt = dot(f.n, tangent);
    const S mt = w * dot(f.meridian, tangent), at = w * dot(f.azimuth, tangent);
    j.gu = w * nt;
    j.huu = f.k * mt * mt + f.ka * at * at - w * nr;
    j.gv = j.huv = j.hvv = 0;
    if (core_) return j;
    const S mv = dot(f.meridian, pv), av = dot(f.azimuth, pv);
    j.gv = dot(f.n, pv);
    j.huv = f.k * mt * mv + f.ka * at * av - r0_ * sv * nt;
    j.hvv = f.k * mv * mv + f.ka * av * av - r0_ * cv * nr - r1_ * sv * dot(f.n, e3_);
    return j;
  }

  /// No point of P at angle u is closer: spheres about the core point and about F.
  S least(const S& u) const
  {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const S cu = R_ * cos(u), su = R_ * sin(u);
    S sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const S x = a_[i] + cu * e1_[i] + su * e2_[i];
      sum += x * x;
    }
    return sqrt(sum) - across() - FR_ - std::max<S>(f0_, f1_);
  }

  /// The value alone, for sampling.
  S value(const S& u, const S& v) const { return at(u, v).value; }

 private:
  struct Field {
    S value, k, ka;
    Point<S> n, meridian, azimuth;
  };

  static std::array<Point<S>, 3> unit_axes(const Torus& t)
  {
    using std::sqrt;
    std::array<Point<S>, 3> e;
    for (int k = 0; k < 2; ++k) {
      Point<S>& x = e[k];
      for (int i = 0; i < 3; ++i) x[i] = S(t.axes(i, k));
      if (k == 1) {
        const S along = dot(x, e[0]);
        for (std::size_t i = 0; i < 3; ++i) x[i] -= along * e[0][i];
      }
      const S length = sqrt(dot(x, x));
      for (S& c : x) c /= length;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      e[2][i] = e[0][j] * e[1][k] - e[0][k] * e[1][j];
    }
    return e;
  }

  Field field(const Point<S>& x) const
  {
    using std::sqrt;
    const S rho = sqrt(x[0] * x[0] + x[1] * x[1]);
    const S cx = rho > 0 ? S(x[0] / rho) : S(1), cy = rho > 0 ? S(x[1] / rho) : S(0), X = rho - FR_;
    Field f;
    S nx, nz;
    if (round_) {
      const S d = sqrt(X * X + x[2] * x[2]);
      nx = d > 0 ? S(X / d) : S(1);
      nz = d > 0 ? S(x[2] / d) : S(0);
      f.value = d - f0_;
      f.k = d > 0 ? S(1 / d) : S(0);
    } else {
      const Profile<S> p = profile_distance<S>(f0_, f1_, X, x[2]);
      nx = p.nx;
      nz = p.nz;
      f.value = p.distance;
      f.k = p.kappa / (1 + p.kappa * p.distance);
    }
    f.ka = rho > 0 ? S(nx / rho) : S(0);
    f.n = {S(nx * cx), S(nx * cy), nz};
    f.meridian = {S(-nz * cx), S(-nz * cy), nx};
    f.azimuth = {S(-cy), cx, S(0)};
    return f;
  }

  bool core_, round_;
  S R_, r0_, r1_, FR_, f0_, f1_;
  Point<S> a_, e1_, e2_, e3_;
};

/// A place on the probed torus and its distance.
template <typename S>
struct Place {
  S u, v, value;
};

/// Descends from (u, v) by Newton's method, turned round along negative curvature, until steps are shorter
/// than `arrived` times the ring (the error of the value is of second order) or nothing falls any more. A
/// saddle is left along its falling direction.
template <typename S>
Place<S> descend(const PairField<S>& f, S u, S v, double arrived)
{
  using std::abs;
  using std::sqrt;
  const S su = f.around(), sv = f.across();
  FieldJet<S> j = f.at(u, v);
  for (int it = 0; it < 60; ++it) {
    const S a = j.huu / (su * su), b = j.huv / (su * sv), c = f.core() ? S(1) : S(j.hvv / (sv * sv));
    const S x = j.gu / su, y = j.gv / sv, slope = sqrt(x * x + y * y);
    const S half = (a - c) / 2, spread = sqrt(half * half + b * b), lowest = (a + c) / 2 - spread;
    S dx, dy;
    if (slope <= S(1e-3) * arrived && lowest < S(-1e-9)) {
      // Eigenvector of the lowest eigenvalue.
      const S p = half > 0 ? S(-b) : S(half - spread), q = half > 0 ? S(half + spread) : S(b);
      const S length = sqrt(p * p + q * q);
      dx = length > 0 ? S(p / length * su / 100) : S(su / 100);
      dy = length > 0 ? S(q / length * su / 100) : S(0);
    } else {
      const S shift = lowest > S(1e-12) ? S(0) : S(S(1e-10) - 2 * std::min<S>(lowest, S(0)));
      const S A = a + shift, C = c + shift, det = A * C - b * b;
      dx = -(C * x - b * y) / det;
      dy = -(A * y - b * x) / det;
    }
    const S length = sqrt(dx * dx + dy * dy), longest = su / 5;
    if (length > longest) {
      dx *= longest / length;
      dy *= longest / length;
    }
    bool moved = false;
    S t = 1;
    for (int halvings = 0; halvings < 12 && !moved; ++halvings, t /= 2) {
      const S nu = u + t * dx / su, nv = v + t * dy / sv;
      const FieldJet<S> next = f.at(nu, nv);
      moved = next.value < j.value;
      if (!moved) continue;
      u = nu;
      v = nv;
      j = next;
    }
    if (!moved || length < S(arrived) * su) break;
  }
  return {u, v, j.value};
}

}  // namespace hauberk::brute
