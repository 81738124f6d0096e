#pragma once
/// Strips: panels of a flat tube that go all around its cross-section, and the part of one that can be near.
///
/// A round tube is probed along its core, by one coordinate. A flat one has two, but of a cross-section only
/// the place that faces the other body matters, and a single look at that place says so of all of it.

#include "geometry/pair_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk {

/// Half-width in v of a strip.
inline constexpr double all_around = std::numbers::pi;
inline bool is_strip(const Panel& s) { return s.hv >= all_around; }

/// Whether the probe set of a frame is looked at in strips: a flat tube before a surface of revolution.
inline bool has_strips(const PairFrame& frame)
{
  return frame.P->is_ellipse() && frame.F->is_torus() && !frame.F->is_point();
}

/// How the points of a strip may move while its window is to hold, see strip_window(). A point at the
/// displacement D from the place that was looked at moves by s (velocity + turn x D) and at most `bend` more,
/// 0 <= s <= 1.
struct StripMotion {
  Vec3 velocity = Vec3::Zero(), turn = Vec3::Zero();
  double bend = 0.0;
};

/// The part of a strip where the field may be below a threshold.
struct StripWindow {
  double half = all_around;  ///< half-width in v about the place that was looked at; 0: nowhere
  /// Of the field over the whole strip; of one that is not known that is without end.
  double bound = -std::numeric_limits<double>::infinity();
};

/// The angle v at which the cross-section of P at u faces F: exact where the field is flat.
inline double facing_angle(const PairFrame& frame, const Angle& u)
{
  const Body &P = *frame.P, &F = *frame.F;
  const Vec3 radial = u.c * frame.e1 + u.s * frame.e2, core = frame.a + P.R * radial;
  const double rho = std::max(std::hypot(core.x(), core.y()), 1e-300);
  const double x = (rho - F.R) / (F.r0 * rho);
  const Vec3 n(x * core.x(), x * core.y(), core.z() / F.r1);
  return std::atan2(-P.r1 * n.dot(frame.e3), -P.r0 * n.dot(radial));
}

/// Where in its v a strip has to be looked at, by the field `f` at its place `q` so far.
///
/// Of a surface whose profile is convex the field is a convex function of (rho, z), in rho with a slope of at
/// least -1, and rho itself is at most x + t^2/(2 x) at the place x along and t across the radius there. So
/// with the displacement D from q, the unit vectors n along the field's gradient, e along F's radius and w
/// across both,
///
///   phi(q + D) >= phi + n . D - kappa (w . D)^2/2,   kappa = max(0, -n . e)/(rho - |e . D|).
///
/// Around the cross-section D is that of an ellipse: for any vector x,
///   x . D = A_x (1 - cos dv) + B_x sin dv = 2 q (A_x q + B_x sqrt(1 - q^2)),   q = |sin(dv/2)|,
///   A_x = -(r0 cos v x . radial + r1 sin v x . e3),   B_x = x . p_v;
/// over u, and while the points move, terms come to it that grow with q no faster than linearly; of the turn,
/// as x . (turn x D) = (x x turn) . D, they are of the same form. In all
///
///   phi >= c - b q + a q^2   for all of the strip with q up to some Q,
///
/// which is below `needed` between two values of q, or nowhere: where a > 0 the cross-section has one nearest
/// place. What is left for Q = 1 is looked at once more with that as Q. Thread safe.
class StripBound {
 public:
  StripBound(const Probe<2>& probe, const Panel& s, const ProbePoint& q, const FieldValue& f,
             const StripMotion& motion)
      : f_(f), widest_(probe.f.P->R + probe.f.P->r0), r0_(probe.f.P->r0)
  {
    const Body& P = *probe.f.P;
    const double here = P.R + P.r0 * q.cv;
    const auto form = [&](const Vec3& x) -> Form {
      const double radial = x.dot(q.radial);
      return {-(P.r0 * q.cv * radial + P.r1 * q.sv * x.dot(probe.f.e3)), x.dot(q.pv),
              s.hu * (std::abs(x.dot(q.pu)) / here + 0.5 * s.hu * std::abs(radial))};
    };
    const Form n = form(f.n), turned = form(f.n.cross(motion.turn));
    convex_ = n.A - std::abs(turned.A);
    skew_ = std::max(std::abs(n.B), std::abs(n.B + turned.B));
    slide_ =
        s.hu * (std::abs(f.n.dot(q.pu)) / here + 0.5 * s.hu * std::max(0.0, f.n.dot(q.radial))) + turned.u;
    level_ = f.m.phi - f.doubt - here * slide_ + std::min(0.0, f.n.dot(motion.velocity)) - motion.bend;
    if (f.m.nr >= 0.0) return;
    const Vec3 e(f.azimuth.y(), -f.azimuth.x(), 0.0);
    along_ = travel(form(e), form(e.cross(motion.turn)), std::abs(e.dot(motion.velocity)) + motion.bend);
    across_ = travel(form(f.azimuth), form(f.azimuth.cross(motion.turn)),
                     std::abs(f.azimuth.dot(motion.velocity)) + motion.bend);
  }

  /// Of the field over the whole strip.
  double bound() const { return upto(1.0, std::numeric_limits<double>::infinity()).bound; }

  StripWindow window(double needed) const
  {
    StripWindow out = upto(1.0, needed);
    if (out.half == 0.0 || out.half >= all_around) return out;
    const StripWindow inner = upto(std::sin(0.5 * out.half), needed);
    // Beyond it nothing is below what is needed.
    return inner.half > 0.0 ? StripWindow{std::min(out.half, inner.half), out.bound}
                            : StripWindow{0.0, std::min(inner.bound, needed)};
  }

 private:
  /// x . D for a vector x: around the cross-section, and the most that a turn by hu gives.
  struct Form {
    double A, B, u;
  };
  /// |x . D| <= swing 2 q + shift.
  struct Travel {
    double swing = 0.0, shift = 0.0;
  };
  Travel travel(const Form& x, const Form& turned, double moved) const
  {
    return {std::hypot(x.A, x.B) + std::hypot(turned.A, turned.B), widest_ * (x.u + turned.u) + moved};
  }

  /// The same where all with q > most is left out.
  StripWindow upto(double most, double needed) const
  {
    double kappa = 0.0;
    if (f_.m.nr < 0.0) {
      const double nearest = f_.rho - 2.0 * most * along_.swing - along_.shift;
      if (!(nearest > 0.0)) return {};
      kappa = -f_.m.nr / nearest;
    }
    const double a = 2.0 * (convex_ - kappa * across_.swing * across_.swing);
    const double b = 2.0 * (skew_ + r0_ * slide_ + kappa * across_.swing * across_.shift);
    const double c = level_ - 0.5 * kappa * across_.shift * across_.shift;
    // Where it falls all the way it is least at the end.
    const double least = b >= 2.0 * a * most ? c + most * (a * most - b) : c - 0.25 * b * b / a;
    if (least >= needed) return {0.0, least};
    if (!(a > 0.0)) return {all_around, least};
    const double end = (b + std::sqrt(b * b - 4.0 * a * (c - needed))) / (2.0 * a);
    return {end < most ? 2.0 * std::asin(end) : all_around, least};
  }

  const FieldValue& f_;
  double widest_, r0_;
  double convex_ = 0.0, skew_ = 0.0, slide_ = 0.0, level_ = 0.0;
  Travel along_, across_;
};

/// See StripBound.
inline StripWindow strip_window(const Probe<2>& probe, const Panel& s, const ProbePoint& q,
                                const FieldValue& f, double needed, const StripMotion& motion = {})
{
  return StripBound(probe, s, q, f, motion).window(needed);
}

}  // namespace hauberk
