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
    const double shift = probe.offset + clearance_, g = f.m.phi - shift;
    if (g < target) return false;
    const double travel = speed_ * tau;
    const PanelBound b = panel_bound(probe, s, q, f);
    if (b.bound - shift - travel >= target) return true;

    // Where a point x of the panel ends when it moves by D, |D| <= travel, the field is, with its Hessian
    // nowhere below -1/rho,
    //   phi(x + D) >= phi(x) + n(x) . D - |D|^2/(2 rho),
    // and n(x) . D differs from n . D at the centre by at most |D^2 phi| d travel and, because the panel
    // turns, by `mixed`. Or all displacements at once, from the centre.
    const double d = b.size, rho = f.rho - d - travel;
    // Relative velocity of the material point: v + w_P x (p - o_P) - w_F x (p - o_F).
    const double rate = f.n.dot(v_ + wp_.cross(q.p - frame_.o) - wf_.cross(q.p - of_));
    const double time = std::max(0.0, -rate) * tau + 0.5 * acceleration_ * tau * tau;
    if (rho > 0.0) {
      const double mixed = angular_ * d * tau;
      const double after = b.bound - shift - b.field.second * d * travel - 0.5 * travel * travel / rho;
      const double space = std::abs(b.gu) * s.hu + std::abs(b.gv) * s.hv + 0.5 * panel_size(probe, s).second;
      const double at_once = g - space - 0.5 * (d + travel) * (d + travel) / rho;
      if (std::max(at_once, after) - time - mixed >= target) return true;
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
        const bool swap = probe_dimension(B) < probe_dimension(A);
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
