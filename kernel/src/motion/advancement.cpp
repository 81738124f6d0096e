#include "track.hpp"

#include <hauberk/geometry/separation.hpp>
#include <hauberk/motion/advancement.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double smallest_advance = 1e-7;  ///< of the whole step; smaller advances are not worth their cost
constexpr int most_advances = 4000;
constexpr double smallest_panel = 1e-9;  ///< radians

/// Certifies one pair of bodies, P probing F, over the remaining step.
template <int dim>
class PairAdvance {
 public:
  PairAdvance(const Body& P, const Track& tp, const Body& F, const Track& tf, double clearance,
              SafeStep& count)
      : P_(P), F_(F), tp_(tp), tf_(tf), clearance_(clearance), count_(count)
  {
  }

  /// Largest s <= limit such that the gap stays above `target`.
  double run(double limit, double target)
  {
    double s = 0.0, tau = limit;
    for (int k = 0; k < most_advances && s < limit; ++k) {
      begin(s);
      tau = std::min(tau, limit - s);
      while (!holds(tau, target)) {
        tau *= 0.5;
        if (tau < smallest_advance) return s;
      }
      s += tau;
      tau *= 2.0;
    }
    return s;
  }

 private:
  void begin(double s)
  {
    Pose pp, pf;
    Vec3 vp, vf;
    tp_.at(s, pp, vp);
    tf_.at(s, pf, vf);
    frame_ = PairFrame(P_, pp, F_, pf);
    const Mat3 Mt = frame_.M.transpose();
    const Vec3 xf = Mt * (pf.position - (pf.position + pf.rotation * F_.center));  // F's element origin
    wp_ = Mt * tp_.w;
    wf_ = Mt * tf_.w;
    v_ = Mt * (vp - vf);
    of_ = xf;
    // Bounds of relative speed and acceleration of P's material points in F's (turning) frame.
    // Over the remaining step the relative position r of a point from F's element origin changes by at most
    // the relative speed itself, so bound the speed with |r| grown by it: V = v + |wp| reach + |wf| r_max.
    const double a0 = tp_.acceleration + tf_.acceleration;
    const double wp = tp_.w.norm(), wf = tf_.w.norm();
    const double reach = P_.reach;
    const double v = v_.norm() + a0;
    const double r = (frame_.o - of_).norm() + v + reach;  // farthest any P point gets from F's origin
    speed_ = v + wp * reach + wf * r;
    angular_ = wp + wf;
    acceleration_ = a0 + wp * wp * reach + wf * wf * r + 2.0 * wf * (v + wp * reach);
  }

  bool holds(double tau, double target)
  {
    const Probe<dim> probe(frame_);
    constexpr int nu = 8, nv = dim == 2 ? 4 : 1;
    for (int i = 0; i < nu; ++i) {
      for (int j = 0; j < nv; ++j) {
        const Panel s{(2 * i + 1) * pi / nu, (2 * j + 1) * pi / nv, pi / nu, dim == 2 ? pi / nv : 0.0};
        if (!panel_holds(probe, s, tau, target)) return false;
      }
    }
    return true;
  }

  bool panel_holds(const Probe<dim>& probe, const Panel& s, double tau, double target)
  {
    const ProbePoint q = probe.at(s.u, s.v);
    const FieldValue f = field_at(F_, q.p);
    ++count_.evaluations;
    const double g = f.m.phi - probe.offset - clearance_;
    if (g < target) return false;
    const double travel = speed_ * tau;
    const PanelSize size = panel_size(probe, s);
    const double d = size.first;
    if (g - d - travel >= target) return true;

    // Relative velocity of the material point: v + w_P x (p - o_P) - w_F x (p - o_F).
    const double rate = f.n.dot(v_ + wp_.cross(q.p - frame_.o) - wf_.cross(q.p - of_));
    const double time = std::max(0.0, -rate) * tau + 0.5 * acceleration_ * tau * tau;
    const double rho = f.rho - d - travel;  // the field's Hessian is nowhere below -1/rho
    if (rho > 0.0) {
      double slope = std::abs(f.n.dot(q.pu)) * s.hu;
      if constexpr (dim == 2) slope += std::abs(f.n.dot(q.pv)) * s.hv;
      const double mixed = angular_ * d * tau;
      const double left = g - slope - time - mixed - target;
      // All displacements at once, from the centre.
      if (left - 0.5 * (size.second + (d + travel) * (d + travel) / rho) >= 0.0) return true;
      // Or over the panel first. A point x of it that moves by D, |D| <= travel, ends at
      //   phi(x + D) >= phi(x) + n(x) . D - |D|^2/(2 rho),
      // and n(x) . D differs from that at the centre by at most |D^2 phi| d travel, besides `mixed`.
      if (left - 0.5 * travel * travel / rho >= 0.0) {
        const FieldCurvature field = field_curvature(F_, f, d);
        if (field.third < std::numeric_limits<double>::infinity()) {
          const double moved = time + mixed + field.second * d * travel + 0.5 * travel * travel / rho;
          if (curved_bound(probe, s, q, f, field) - probe.offset - clearance_ - moved >= target) return true;
        }
      }
    }
    // Time alone already fails: a shorter advance is needed.
    const double alone = rho > 0.0 ? time + 0.5 * travel * travel / rho : travel;
    if (g - std::min(alone, travel) < target) return false;
    if (s.hu < smallest_panel) return false;
    Panel first, second_panel;
    split(probe, s, first, second_panel);
    return panel_holds(probe, first, tau, target) && panel_holds(probe, second_panel, tau, target);
  }

  const Body& P_;
  const Body& F_;
  const Track& tp_;
  const Track& tf_;
  double clearance_;
  SafeStep& count_;
  PairFrame frame_{P_, Pose{}, F_, Pose{}};
  Vec3 v_, wp_, wf_, of_;
  double speed_ = 0.0, angular_ = 0.0, acceleration_ = 0.0;
};

}  // namespace

SafeStep largest_safe_step(const Model& m, const State& from, const Vector& dy, double keep)
{
  SafeStep out;
  out.alpha = wall_step(m, from, dy, keep);
  for (const CandidatePair& pair : candidate_pairs(m, from, dy)) {
    const Track &ti = pair.ti, &tj = pair.tj;
    const auto i = static_cast<std::size_t>(ti.element), j = static_cast<std::size_t>(tj.element);
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[static_cast<std::size_t>(a)];
        const Body& B = m.bodies[static_cast<std::size_t>(b)];
        const double motion = pair.approach + ti.w.norm() * A.reach + tj.w.norm() * B.reach;
        const Separation now = separation(A, pair.pi, B, pair.pj, m.clearance, 2.0 * motion);
        out.evaluations += now.evaluations;
        const double gap = now.lower;
        if (gap - out.alpha * motion >= keep * gap && gap > 0.0) continue;
        if (gap <= 0.0) {
          out.alpha = 0.0;
          return out;
        }
        ++out.tight_pairs;
        const double target = keep * gap;
        // Of equal kinds the smaller ring probes, see separation().
        const bool swap = probe_dimension(B) < probe_dimension(A) ||
                          (probe_dimension(B) == probe_dimension(A) && B.R < A.R);
        const Body &P = swap ? B : A, &F = swap ? A : B;
        const Track &tp = swap ? tj : ti, &tf = swap ? ti : tj;
        out.alpha = probe_dimension(P) == 1
                        ? PairAdvance<1>(P, tp, F, tf, m.clearance, out).run(out.alpha, target)
                        : PairAdvance<2>(P, tp, F, tf, m.clearance, out).run(out.alpha, target);
        if (out.alpha <= 0.0) return out;
      }
    }
  }
  return out;
}

}  // namespace hauberk
