#include "facet_advancement.hpp"
#include "track.hpp"

#include <hauberk/geometry/panel_field.hpp>
#include <hauberk/geometry/separation.hpp>
#include <hauberk/motion/advancement.hpp>
#include <hauberk/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hauberk {
namespace {

constexpr double smallest_advance = 1e-7;  ///< of the whole step; smaller advances are not worth their cost
/// A pair that ends a step does so where its gap has become small, and that place is approached ever more
/// slowly. An advance by less than this part of what is behind it is the last one.
constexpr double worth_going_on = 0.125;
/// What is certified of gaps to be remembered, where the whole motion is below that part of them.
constexpr double remembered = 0.5, spare = 0.25;
constexpr int most_advances = 4000;
constexpr double smallest_panel = 1e-9;  ///< radians
/// Closest points that one pair is worth: conforming surfaces near contact could take any number. What is
/// certified until then stands.
constexpr long most_evaluations = 2000000;
/// Pairs of bodies from which on pairs are advanced together, and how many.
constexpr std::size_t large_scene = 128, taken_together = 16;

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

  /// A part of the step, at most `limit`, over which the gap stays above `keep` times the smallest one seen
  /// at its start, which is not below the gap: nearly as far as it does.
  ///
  /// `remember`: where there is room to spare, more of the gap is certified than that, for `bound`.
  double run(double limit, double keep, bool remember)
  {
    double s = 0.0, tau = limit;
    begin(s);
    if (remember && limit > 0.0 && speed_ * limit <= spare * gap_at(Probe<dim>(frame_), panels_.front()) &&
        certified(limit, std::max(keep, remembered)) == limit) {
      bound_ = target_;
      return limit;
    }
    for (int k = 0; k < most_advances && s < limit; ++k) {
      if (k > 0) begin(s);
      tau = certified(std::min(tau, limit - s), k == 0 ? keep : 0.0);
      if (k == 0 && tau > 0.0) bound_ = target_;
      if (tau <= 0.0) return s;
      s += tau;
      if (tau < worth_going_on * s) return s;
      tau *= 2.0;
    }
    return s;
  }

  /// What the gap at the beginning is not below; 0 where that was not certified.
  double bound() const { return bound_; }

 private:
  void begin(double s)
  {
    Pose pp, pf;
    Vec3 vp, vf;
    tp_.at(s, pp, vp);
    tf_.at(s, pf, vf);
    frame_ = PairFrame(P_, pp, F_, pf);
    touching_ = gap_rounding(frame_);
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

    const Probe<dim> probe(frame_);
    const FirstPanels<dim> first(probe);
    for (int k = 0; k < FirstPanels<dim>::rows; ++k) {
      std::array<PanelField, 4> row = first.row(k);
      fill_fields(*frame_.F, row);
      std::copy(row.begin(), row.end(), panels_.begin() + 4 * k);
    }
    std::iter_swap(panels_.begin(), std::min_element(panels_.begin(), panels_.end(),
                                                     [](const PanelField& a, const PanelField& b) {
                                                       return a.f.m.phi < b.f.m.phi;
                                                     }));
  }

  /// How long the gap stays above the target from the time of `begin`, at most `tau`; 0 if that is not worth
  /// it. A panel that fails because of time alone halves tau. Panels that held for longer hold for shorter
  /// times as well, so that none is looked at again.
  ///
  /// With keep > 0 the target is that part of the smallest gap seen. It falls while panels are looked at,
  /// from the nearest one on, and those that held above a higher one hold.
  double certified(double tau, double keep)
  {
    const Probe<dim> probe(frame_);
    if (keep > 0.0) target_ = std::numeric_limits<double>::infinity();
    for (const PanelField& p : panels_)
      if (!holds(probe, p, tau, keep)) return 0.0;
    return tau;
  }

  double gap_at(const Probe<dim>& probe, const PanelField& p) const
  {
    return p.f.m.phi - probe.offset - clearance_;
  }

  /// True where a panel holds for the time tau, which it may halve.
  bool holds(const Probe<dim>& probe, const PanelField& p, double& tau, double keep)
  {
    ++count_.evaluations;
    const double gap = gap_at(probe, p);
    if (keep > 0.0) target_ = std::min(target_, keep * gap);
    if (gap <= std::max(target_, touching_)) return false;
    Verdict verdict = look(probe, p.s, p.q, p.f, tau, target_);
    while (verdict == Verdict::too_long) {
      tau *= 0.5;
      if (tau < smallest_advance || count_.evaluations >= last_) return false;
      verdict = look(probe, p.s, p.q, p.f, tau, target_);
    }
    if (verdict == Verdict::holds) return true;
    const std::array<PanelField, 2> half = split(probe, p);
    const bool swapped = half[1].f.m.phi < half[0].f.m.phi;  // nearer first
    return holds(probe, half[swapped ? 1 : 0], tau, keep) && holds(probe, half[swapped ? 0 : 1], tau, keep);
  }

  enum class Verdict { holds, too_wide, too_long };

  Verdict look(const Probe<dim>& probe, const Panel& s, const ProbePoint& q, const FieldValue& f, double tau,
               double target) const
  {
    const double g = f.m.phi - probe.offset - clearance_;
    const double travel = speed_ * tau;
    const PanelSize size = panel_size(probe, s);
    const double d = size.first;
    if (g - d - travel >= target) return Verdict::holds;

    const Motion motion = motion_of(q, f);
    const double time = std::max(0.0, -motion.rate) * tau + 0.5 * acceleration_ * tau * tau;
    const double rho = f.rho - d - travel;  // the field's Hessian is nowhere below -1/rho
    double slope = std::abs(f.n.dot(q.pu)) * s.hu;
    if constexpr (dim == 2) slope += std::abs(f.n.dot(q.pv)) * s.hv;
    const double second = size.second + (d + travel) * (d + travel) / rho;
    if (rho > 0.0 && g - slope - time - angular_ * d * tau - 0.5 * second >= target) return Verdict::holds;
    const PanelSize path = path_size(size, tau);
    const auto stays = [&](const FieldValue& of, const FieldCurvature& field) {
      const double left = g - lost(motion, of, field, path, tau);
      return left >= target && left + expanded(probe, s, q, of, motion, tau) >= target;
    };
    if (!frame_.F->is_tube()) {
      const RolledField rolled(*frame_.F, f);
      if (stays(rolled.f, rolled.curvature(path.first))) return Verdict::holds;
    }
    if (stays(f, field_curvature(*frame_.F, f, path.first))) return Verdict::holds;

    // Time alone already fails: a shorter advance is needed.
    const double alone = rho > 0.0 ? time + 0.5 * travel * travel / rho : travel;
    const PanelSize moved = path_size({}, tau);
    if (g - std::min(alone, travel) < target &&
        g - lost(motion, f, field_curvature(*frame_.F, f, moved.first), moved, tau) < target)
      return Verdict::too_long;
    return s.hu < smallest_panel || count_.evaluations >= last_ ? Verdict::too_long : Verdict::too_wide;
  }

  /// How a material point of P moves in F's frame, and what that does to the field.
  struct Motion {
    Vec3 velocity;
    double rate;     ///< n . velocity
    double turning;  ///< n . acceleration, without the origins' own: with D^2 phi[velocity, velocity] the
                     ///< second derivative of the field in time
  };

  Motion motion_of(const ProbePoint& q, const FieldValue& f) const
  {
    // x = R_F^T (x_P - o_F) with R_F = exp(w_F t), x_P = o_P + exp(w_P t) arm:
    //   x' = v + w_P x arm - w_F x y,  x'' = w_P x (w_P x arm) + w_F x (w_F x y) - 2 w_F x (v + w_P x arm).
    const Vec3 arm = q.on_p - frame_.o, y = q.on_p - of_;
    const Vec3 own = v_ + wp_.cross(arm);
    Motion out;
    out.velocity = own - wf_.cross(y);
    out.rate = f.n.dot(out.velocity);
    const Vec3 turning = wp_.cross(wp_.cross(arm)) + wf_.cross(wf_.cross(y)) - 2.0 * wf_.cross(own);
    out.turning = f.n.dot(turning);
    return out;
  }

  /// d^2 phi/(du dt), p_u or p_v given; `turns` as P does, not so along F's own core.
  double mixed_derivative(const FieldValue& f, const Vec3& along, const Motion& motion, bool turns) const
  {
    const double curved = field_hessian(f, along, motion.velocity);
    return turns ? curved + f.n.dot((wp_ - wf_).cross(along)) : curved;
  }

  /// Bounds of the paths of points over a panel of this size and a time tau.
  PanelSize path_size(const PanelSize& size, double tau) const
  {
    return {size.first + speed_ * tau,
            size.second + 2.0 * angular_ * size.first * tau + acceleration_ * tau * tau,
            size.third + 3.0 * angular_ * size.second * tau +
                3.0 * angular_ * angular_ * size.first * tau * tau + jerk_ * tau * tau * tau};
  }

  /// Least change of the field over a panel and a time tau, by its expansion in (u, v, t) to second order
  /// without the terms in t alone, which `lost` has. Never positive.
  double expanded(const Probe<dim>& probe, const Panel& s, const ProbePoint& q, const FieldValue& f,
                  const Motion& motion, double tau) const
  {
    double cross = std::abs(mixed_derivative(f, q.pu, motion, true)) * s.hu * tau;
    if constexpr (dim == 2)
      cross += std::abs(mixed_derivative(f, q.pv, motion, frame_.difference == nullptr)) * s.hv * tau;
    return least_to_second_order(probe, s, q, f) - cross;
  }

  /// What time and the third order may take off the field: the expansion without its terms in u and v alone
  /// and without d^2 phi/(du dt). Origins accelerate in unknown directions.
  double lost(const Motion& motion, const FieldValue& f, const FieldCurvature& field, const PanelSize& path,
              double tau) const
  {
    if (!(field.third < std::numeric_limits<double>::infinity())) return field.third;
    const double second = field_hessian(f, motion.velocity, motion.velocity) + motion.turning;
    return std::max(0.0, -motion.rate) * tau + 0.5 * (std::max(0.0, -second) + origins_) * tau * tau +
           third_order(field, path);
  }

  const Body& P_;
  const Body& F_;
  const Track& tp_;
  const Track& tf_;
  double clearance_;
  SafeStep& count_;
  long last_;              ///< evaluation after which to give up
  double target_ = 0.0;    ///< what the gap has to stay above
  double bound_ = 0.0;     ///< see bound()
  double touching_ = 0.0;  ///< what of a gap is rounding
  PairFrame frame_{P_, Pose{}, F_, Pose{}};
  Vec3 v_, wp_, wf_, of_;
  double speed_ = 0.0, angular_ = 0.0, acceleration_ = 0.0;
  double origins_ = 0.0;  ///< the part of the acceleration that the elements' origins have
  double jerk_ = 0.0;     ///< bound of the third derivative, origins moving evenly
  std::array<PanelField, 4 * FirstPanels<dim>::rows> panels_;  ///< the first ones, the nearest before others
};

/// Two bodies that the step can bring together.
struct BodyPair {
  const CandidatePair* pair;
  int a, b;
  const Body &A, &B;
  double motion;  ///< bound of how far their points come together over the whole step
};

/// One that the first look does not free, and what the second one finds.
struct Tight {
  const BodyPair* bodies;
  double alpha;
  SafeStep count;
  double bound = 0.0;  ///< of the gap at the beginning
};

std::vector<BodyPair> body_pairs(const Model& m, const std::vector<CandidatePair>& candidates)
{
  std::vector<BodyPair> out;
  for (const CandidatePair& pair : candidates) {
    const auto i = static_cast<std::size_t>(pair.ti.element), j = static_cast<std::size_t>(pair.tj.element);
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[static_cast<std::size_t>(a)];
        const Body& B = m.bodies[static_cast<std::size_t>(b)];
        out.push_back(
            {&pair, a, b, A, B, pair.approach + pair.ti.w.norm() * A.reach + pair.tj.w.norm() * B.reach});
      }
    }
  }
  return out;
}

/// True if a surface that probes is inside of the body that it probes. A core that is probed knows the inside
/// of its own tube. Where all of a surface is inside of another, so is any point of it.
bool inside(const PairFrame& frame)
{
  return probe_dimension(frame) == 2 && frame.difference == nullptr &&
         field_at(*frame.F, Probe<2>(frame).at(0.0, 0.0).p).m.phi < 0.0;
}

/// Looks for the part of [0, alpha] over which a pair keeps that part of its gap.
void advance(Tight& tight, double clearance, double alpha, double keep, bool remember)
{
  const BodyPair& bodies = *tight.bodies;
  const CandidatePair& pair = *bodies.pair;
  const Body &A = bodies.A, &B = bodies.B;
  // Of equal kinds the smaller ring probes, see separation().
  const bool swap = probe_rank(B) < probe_rank(A) || (probe_rank(B) == probe_rank(A) && B.R < A.R);
  const Body &P = swap ? B : A, &F = swap ? A : B;
  const Pose &pp = swap ? pair.pj : pair.pi, &pf = swap ? pair.pi : pair.pj;
  const Track &tp = swap ? pair.tj : pair.ti, &tf = swap ? pair.ti : pair.tj;
  if (inside(PairFrame(P, pp, F, pf)) || inside(PairFrame(F, pf, P, pp))) return;
  const auto run = [&](auto&& pair_advance) {
    tight.alpha = pair_advance.run(alpha, keep, remember);
    tight.bound = pair_advance.bound();
  };
  if (probe_dimension(PairFrame(P, pp, F, pf)) == 1) {
    run(PairAdvance<1>(P, tp, F, tf, clearance, tight.count));
  } else {
    run(PairAdvance<2>(P, tp, F, tf, clearance, tight.count));
  }
}

}  // namespace

SafeStep largest_safe_step(const Model& m, const State& from, const Vector& dy, double keep, unsigned threads,
                           GapBounds* bounds)
{
  SafeStep out;
  out.alpha = wall_step(m, from, dy, keep);
  const std::vector<CandidatePair> candidates = candidate_pairs(m, from, dy);
  const std::vector<BodyPair> all = body_pairs(m, candidates);
  // What is found so far shortens the rest. In a large scene pairs are taken together, from the same alpha,
  // also by one thread, as the number of threads may not change what is found.
  const std::size_t most = all.size() >= large_scene ? taken_together : 1;
  std::vector<Tight> tight;
  const auto advance_all = [&] {
    parallel_for(tight.size(), threads,
                 [&](std::size_t i) { advance(tight[i], m.clearance, out.alpha, keep, bounds != nullptr); });
    for (const Tight& t : tight) {
      const CandidatePair& pair = *t.bodies->pair;
      if (bounds != nullptr && t.bound > 0.0)
        bounds->remember(m, t.bodies->a, pair.pi, t.bodies->b, pair.tj.image, pair.pj, t.bound);
      out.alpha = std::min(out.alpha, t.alpha);
      out.evaluations += t.count.evaluations;
    }
    tight.clear();
  };
  for (std::size_t k = 0; k < all.size() && out.alpha > 0.0; ++k) {
    const BodyPair& bodies = all[k];
    const CandidatePair& pair = *bodies.pair;
    if (bodies.A.facets) {
      out.alpha = advance_facets(bodies.A, pair.ti, bodies.B, pair.tj, m.clearance, out.alpha, keep, out);
      continue;
    }
    const auto far = [&](double apart) {
      return apart > 0.0 && (1.0 - keep) * apart >= out.alpha * bodies.motion;
    };
    if (far(ball_gap(bodies.A, pair.pi, bodies.B, pair.pj, m.clearance))) continue;
    if (bounds != nullptr && far(bounds->at_least(m, bodies.a, pair.pi, bodies.b, pair.tj.image, pair.pj)))
      continue;
    ++out.tight_pairs;
    tight.push_back({&bodies, 0.0, {}});
    if (tight.size() == most) advance_all();
  }
  if (out.alpha > 0.0) advance_all();
  return out;
}

}  // namespace hauberk
