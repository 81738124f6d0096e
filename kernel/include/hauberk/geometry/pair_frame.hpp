#pragma once
/// Two bodies seen from one of them: probe points of body P in the distance field of body F.
///
/// Every exact distance that is needed reduces to "points that ride on P, in the closed-form distance field
/// of F": a circle tube is probed along its core circle (one angle u, offset r), any other body over its
/// surface (two angles u, v, no offset). Both contact formulations, the certified lower bound and the
/// collision check are written once, on this reduction.

#include <hauberk/geometry/meridian.hpp>

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

  PairFrame(const Body& p, const Pose& pose_p, const Body& f, const Pose& pose_f);
};

/// A probe point and its derivatives with respect to the probe coordinates.
struct ProbePoint {
  Vec3 p, pu, pv;
  Vec3 radial;  ///< outward in the ring's plane of P, at angle u
  double cv = 0.0, sv = 0.0;
};

/// An angle by its cosine and sine.
struct Angle {
  double c = 1.0, s = 0.0;

  Angle() = default;
  /// To a few units of rounding, by a table and series: a third of the time of the library's functions.
  explicit Angle(double radians);

  /// This angle and `by` more; for |by| <= 1/4 by series of which nothing above rounding is left out.
  Angle turned(double by) const
  {
    Angle t;
    if (std::abs(by) > 0.25) {
      t = Angle(by);
    } else {
      const double q = by * by;
      const auto term = [q](double rest, double n) { return 1.0 - q / n * rest; };
      t.s = by * term(term(term(term(term(term(1.0, 156.0), 110.0), 72.0), 42.0), 20.0), 6.0);
      t.c = term(term(term(term(term(term(1.0, 132.0), 90.0), 56.0), 30.0), 12.0), 2.0);
    }
    return turned(t);
  }
  Angle turned(const Angle& by) const { return {c * by.c - s * by.s, s * by.c + c * by.s}; }

 private:
  Angle(double cosine, double sine) : c(cosine), s(sine) {}
};

/// Probe set of dimension 1 (core circle of a tube) or 2 (surface).
template <int dim>
struct Probe {
  const PairFrame& f;
  double Lu, Lv, Luv;  ///< bounds of |p_u| and |p_uu|, of |p_v| and |p_vv|, and of |p_uv|
  double offset;       ///< gap = field - offset - clearance

  explicit Probe(const PairFrame& frame);
  ProbePoint at(const Angle& u, const Angle& v) const;
  ProbePoint at(double u, double v) const { return at(Angle(u), dim == 1 ? Angle() : Angle(v)); }
};

template <int dim>
Probe<dim>::Probe(const PairFrame& frame) : f(frame)
{
  const Body& b = *f.P;
  if constexpr (dim == 1) {
    Lu = b.R;
    Lv = Luv = 0.0;
    offset = b.r0;
  } else {
    Lu = b.R + b.r0;
    Lv = std::max(b.r0, b.r1);
    Luv = b.r0;
    offset = 0.0;
  }
}

template <int dim>
ProbePoint Probe<dim>::at(const Angle& u, const Angle& v) const
{
  const Body& b = *f.P;
  ProbePoint q;
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
  return q;
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

/// Splits the longer side of a panel in two.
template <int dim>
inline void split(const Probe<dim>& probe, const Panel& s, Panel& first, Panel& second)
{
  const std::array<Panel, 2> half = halves(s, dim == 1 || probe.Lu * s.hu >= probe.Lv * s.hv);
  first = half[0];
  second = half[1];
}

/// True if P is probed along its core circle.
inline int probe_dimension(const Body& P) { return P.is_tube() ? 1 : 2; }

}  // namespace hauberk
