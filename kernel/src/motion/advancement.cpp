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
/// Closest points that one pair is worth: conforming surfaces near contact could take any number. What is
/// certified until then stands.
constexpr long most_evaluations = 2000000;

/// Certifies one pair of bodies, P probing F, over the remaining step.
template <int dim>
class PairAdvance {
 public:
  PairAdvance(const Body& P, const Track& tp, const Body& F, const Track& tf, double clearance,
              SafeStep& count)
      : P_(P),
        F_(F),
        tp_(tp),
        tf_(tf),
        clearance_(clearance),
        count_(count),
        last_(count.evaluations + most_evaluations)
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
        if (tau < smallest_advance || count_.evaluations >= last_) return s;
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
    origins_ = a0;
    jerk_ = wp * wp * wp * reach + 3.0 * wf * wp * wp * reach + 3.0 * wf * wf * (v + wp * reach) +
            wf * wf * wf * r;
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

    const Motion motion = motion_of(q, f);
    const double time = std::max(0.0, -motion.rate) * tau + 0.5 * acceleration_ * tau * tau;
    const double rho = f.rho - d - travel;  // the field's Hessian is nowhere below -1/rho
    double slope = std::abs(f.n.dot(q.pu)) * s.hu;
    if constexpr (dim == 2) slope += std::abs(f.n.dot(q.pv)) * s.hv;
    const double second = size.second + (d + travel) * (d + travel) / rho;
    if (rho > 0.0 && g - slope - time - angular_ * d * tau - 0.5 * second >= target) return true;
    double cross = std::abs(mixed_derivative(f, q.pu, motion)) * s.hu * tau;
    if constexpr (dim == 2) cross += std::abs(mixed_derivative(f, q.pv, motion)) * s.hv * tau;
    const double form = panel_terms(probe, s, q, f).form;
    if (g - slope + 0.5 * form - cross - lost(motion, f, size, tau) >= target) return true;

    // Time alone already fails: a shorter advance is needed.
    const double alone = rho > 0.0 ? time + 0.5 * travel * travel / rho : travel;
    if (g - std::min(alone, travel) < target && g - lost(motion, f, {}, tau) < target) return false;
    if (s.hu < smallest_panel || count_.evaluations >= last_) return false;
    Panel first, second_panel;
    split(probe, s, first, second_panel);
    return panel_holds(probe, first, tau, target) && panel_holds(probe, second_panel, tau, target);
  }

  /// How a material point of P moves in F's frame, and what that does to the field.
  struct Motion {
    Vec3 velocity;
    double rate;    ///< n . velocity
    double second;  ///< second derivative of the field in time, without the origins' acceleration
  };

  Motion motion_of(const ProbePoint& q, const FieldValue& f) const
  {
    // x = R_F^T (x_P - o_F) with R_F = exp(w_F t), x_P = o_P + exp(w_P t) arm:
    //   x' = v + w_P x arm - w_F x y,  x'' = w_P x (w_P x arm) + w_F x (w_F x y) - 2 w_F x (v + w_P x arm).
    const Vec3 arm = q.p - frame_.o, y = q.p - of_;
    const Vec3 own = v_ + wp_.cross(arm);
    Motion out;
    out.velocity = own - wf_.cross(y);
    out.rate = f.n.dot(out.velocity);
    const Vec3 turning = wp_.cross(wp_.cross(arm)) + wf_.cross(wf_.cross(y)) - 2.0 * wf_.cross(own);
    out.second = field_hessian(f, out.velocity, out.velocity) + f.n.dot(turning);
    return out;
  }

  /// d^2 phi/(du dt), p_u or p_v given.
  double mixed_derivative(const FieldValue& f, const Vec3& along, const Motion& motion) const
  {
    return field_hessian(f, along, motion.velocity) + f.n.dot((wp_ - wf_).cross(along));
  }

  /// What time and the third order may take off the field over a panel of this size: the expansion in (u, v,
  /// t) without its terms in u and v alone and without d^2 phi/(du dt). Origins accelerate in unknown
  /// directions.
  double lost(const Motion& motion, const FieldValue& f, const PanelSize& size, double tau) const
  {
    const PanelSize path{size.first + speed_ * tau,
                         size.second + 2.0 * angular_ * size.first * tau + acceleration_ * tau * tau,
                         size.third + 3.0 * angular_ * size.second * tau +
                             3.0 * angular_ * angular_ * size.first * tau * tau + jerk_ * tau * tau * tau};
    const FieldCurvature field = field_curvature(F_, f, path.first);
    if (!(field.third < std::numeric_limits<double>::infinity())) return field.third;
    return std::max(0.0, -motion.rate) * tau + 0.5 * (std::max(0.0, -motion.second) + origins_) * tau * tau +
           third_order(field, path);
  }

  const Body& P_;
  const Body& F_;
  const Track& tp_;
  const Track& tf_;
  double clearance_;
  SafeStep& count_;
  long last_;  ///< evaluation after which to give up
  PairFrame frame_{P_, Pose{}, F_, Pose{}};
  Vec3 v_, wp_, wf_, of_;
  double speed_ = 0.0, angular_ = 0.0, acceleration_ = 0.0;
  double origins_ = 0.0;  ///< the part of the acceleration that the elements' origins have
  double jerk_ = 0.0;     ///< bound of the third derivative, origins moving evenly
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
