#pragma once
/// Two bodies seen from one of them: probe points of body P in the distance field of body F.
///
/// Every exact distance that is needed reduces to "points that ride on P, in the closed-form distance field
/// of F": a tube is probed along its core (one coordinate u, offset r), any other body over its surface (two
/// angles u, v, no offset). Two curve tubes are their difference x_P(u) - x_F(v), a surface, in the distance
/// field of a point. The contact formulations, the certified lower bound and the collision check are written
/// once, on this reduction.

#include "geometry/closed_curve.hpp"
#include "geometry/meridian.hpp"

#include <array>

namespace hauberk {

/// Geometry of body P relative to the frame of body F (F's axis is e_z, its centre the origin).
struct PairFrame {
  const Body* P = nullptr;
  const Body* F = nullptr;
  Mat3 M;           ///< F's axes in the world: world vector = M * local vector
  Vec3 a;           ///< centre of P
  Vec3 e1, e2, e3;  ///< axes of P
  Vec3 o;           ///< origin of P's element: rotations of that element turn about it
  /// Of two curve tubes: F's core; then F is the point that the difference of both cores is probed against,
  /// with the radius of F's tube. Else null.
  const ClosedCurve* difference = nullptr;
  /// F's mesh, where it has one; also of a curve tube that F is not itself.
  const Facets* F_facets = nullptr;

  PairFrame(const Body& p, const Pose& pose_p, const Body& f, const Pose& pose_f);
};

/// A probe point and its derivatives with respect to the probe coordinates.
struct ProbePoint {
  Vec3 p, pu, pv;
  Vec3 on_p;    ///< point that rides on P; p itself, unless it is a difference
  Vec3 radial;  ///< outward in the ring's plane of P, at angle u; of a curve -p_uu/R; of solids not known
  Vec3 pvv;     ///< of differences only
  Angle u, v;   ///< of curves and solids only
  double cv = 0.0, sv = 0.0;
};

/// n . p_uu, n . p_uv, n . p_vv for a vector n; only uu in dimension 1.
struct SecondDerivatives {
  double uu = 0.0, uv = 0.0, vv = 0.0;
};

/// Probe set of dimension 1 (core of a tube) or 2 (surface, or difference of two cores).
template <int dim>
struct Probe {
  const PairFrame& f;
  double Lu, Lv;           ///< bounds of |p_u| and |p_v|
  double Luu, Luv, Lvv;    ///< of second derivatives
  double Luuu, Lvvv;       ///< of third derivatives; mixed ones are bounded by Luv
  double offset;           ///< gap = field - offset - clearance
  double frequency = 1.0;  ///< how much faster than on a torus the probe set turns

  explicit Probe(const PairFrame& frame);
  /// Of a solid.
  void set_bounds();
  void locate_on_solid(const Angle& u, const Angle& v, ProbePoint& q) const;
  SecondDerivatives solid_second(const ProbePoint& q, const Vec3& n) const;
  ProbePoint at(const Angle& u, const Angle& v) const;
  ProbePoint at(double u, double v) const { return at(Angle(u), dim == 1 ? Angle() : Angle(v)); }
  SecondDerivatives second(const ProbePoint& q, const Vec3& n) const;

 private:
  /// The core of P, in F's frame.
  CurvePoint core(const Angle& u) const
  {
    const CurvePoint c = f.P->curve->at(u);
    const auto turned = [this](const Vec3& x) -> Vec3 { return x[0] * f.e1 + x[1] * f.e2 + x[2] * f.e3; };
    return {f.a + turned(c.x), turned(c.xu), turned(c.xuu)};
  }
};

/// How fast the direction of a curve turns, by its derivatives, sqrt(|x_uuu|/|x_u|); 1 for a circle.
inline double turning(const ClosedCurve& curve) { return std::sqrt(curve.third() / curve.first()); }

template <int dim>
Probe<dim>::Probe(const PairFrame& frame) : f(frame)
{
  const Body& b = *f.P;
  if (b.solid) {
    set_bounds();
  } else if (b.curve) {
    Lu = b.curve->first();
    Luu = b.curve->second();
    Luuu = b.curve->third();
    Lv = Luv = Lvv = Lvvv = 0.0;
    offset = b.r0;
    frequency = turning(*b.curve);
    if (dim == 2) {
      Lv = f.difference->first();
      Lvv = f.difference->second();
      Lvvv = f.difference->third();
      frequency = std::max(frequency, turning(*f.difference));
    }
  } else if constexpr (dim == 1) {
    Lu = Luu = Luuu = b.R;
    Lv = Luv = Lvv = Lvvv = 0.0;
    offset = b.r0;
  } else {
    Lu = Luu = Luuu = b.R + b.r0;
    Lv = Lvv = Lvvv = std::max(b.r0, b.r1);
    Luv = b.r0;
    offset = 0.0;
  }
}

template <int dim>
ProbePoint Probe<dim>::at(const Angle& u, const Angle& v) const
{
  const Body& b = *f.P;
  ProbePoint q;
  if (!b.is_torus()) {
    if (b.solid) {
      locate_on_solid(u, v, q);
      return q;
    }
    const CurvePoint c = core(u);
    q.p = q.on_p = c.x;
    q.pu = c.xu;
    q.radial = (-1.0 / b.R) * c.xuu;
    q.u = u;
    if constexpr (dim == 1) {
      q.pv.setZero();
    } else {
      const CurvePoint other = f.difference->at(v);
      q.p -= other.x;
      q.pv = -other.xu;
      q.pvv = -other.xuu;
      q.v = v;
    }
    return q;
  }
  q.radial = u.c * f.e1 + u.s * f.e2;
  const Vec3 tangent = -u.s * f.e1 + u.c * f.e2;
  if constexpr (dim == 1) {
    q.p = f.a + b.R * q.radial;
    q.pu = b.R * tangent;
    q.pv.setZero();
  } else {
    q.cv = v.c;
    q.sv = v.s;
    const double w = b.R + b.r0 * q.cv;
    q.p = f.a + w * q.radial + b.r1 * q.sv * f.e3;
    q.pu = w * tangent;
    q.pv = -b.r0 * q.sv * q.radial + b.r1 * q.cv * f.e3;
  }
  q.on_p = q.p;
  return q;
}

template <int dim>
SecondDerivatives Probe<dim>::second(const ProbePoint& q, const Vec3& n) const
{
  const Body& P = *f.P;
  if (!P.is_torus() && P.solid) return solid_second(q, n);
  const double nr = n.dot(q.radial);
  if constexpr (dim == 1) {
    return {-P.R * nr};
  } else {
    if (f.difference != nullptr) return {-P.R * nr, 0.0, n.dot(q.pvv)};
    const double w = P.R + P.r0 * q.cv;
    return {-w * nr, -P.r0 * q.sv / w * n.dot(q.pu), -P.r0 * q.cv * nr - P.r1 * q.sv * n.dot(f.e3)};
  }
}

/// A box of probe coordinates: centre and half-widths (v and hv unused for dimension 1).
struct Panel {
  double u = 0.0, v = 0.0, hu = 0.0, hv = 0.0;
};

/// The halves of a panel.
inline std::array<Panel, 2> halves(const Panel& s, bool along_u)
{
  std::array<Panel, 2> out{s, s};
  if (along_u) {
    out[0].hu = out[1].hu = 0.5 * s.hu;
    out[0].u = s.u - out[0].hu;
    out[1].u = s.u + out[0].hu;
  } else {
    out[0].hv = out[1].hv = 0.5 * s.hv;
    out[0].v = s.v - out[0].hv;
    out[1].v = s.v + out[0].hv;
  }
  return out;
}

/// Which body of a pair probes the other: the one of the lower rank. A curve always does, as its field has no
/// closed form; a surface does only where both are.
inline int probe_rank(const Body& b)
{
  if (b.solid) return solid_probe_dimension(b) == 1 ? 2 : 4;
  return b.curve ? 0 : b.is_circle_tube() ? 1 : 3;
}

/// True where of two bodies the second one probes the first: of equal kinds the smaller ring, as the field of
/// the larger one is smooth around it, while a ring that is threaded through a small one runs along its axis,
/// where the field is not. The difference of two curves knows no order.
inline bool second_probes(const Body& a, const Body& b)
{
  const int of_a = probe_rank(a), of_b = probe_rank(b);
  return of_b < of_a || (of_b == of_a && !a.curve && b.R < a.R);
}

/// Dimension of the probe set of a frame.
inline int probe_dimension(const PairFrame& frame)
{
  if (frame.P->solid) return solid_probe_dimension(*frame.P);
  if (frame.P->curve) return frame.difference != nullptr ? 2 : 1;
  return frame.P->is_circle_tube() ? 1 : 2;
}

}  // namespace hauberk
