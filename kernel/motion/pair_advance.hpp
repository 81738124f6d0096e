#pragma once
/// How far two bodies go along a step while their gap stays open, certified panel by panel.

#include "geometry/panel_field.hpp"
#include "geometry/separation.hpp"
#include "motion/gap_bounds.hpp"
#include "motion/track.hpp"
#include "numerics/interrupted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace hauberk {

/// Certifies one pair of bodies, P probing F, over a step; see largest_safe_step() for the bounds.
///
/// What is known of the gap, a lower bound over every panel of the probe set, is where it begins and what it
/// leaves behind. While bodies move from one placement to another all bounds fall by no more than what has
/// moved, so panels are looked at by rising bound until the next one stays open by its bound alone; those
/// that were looked at have been split as far as was needed, and have better bounds.
template <int dim>
class PairAdvance {
 public:
  /// `known`: of this pair, from any placement; null where nothing is.
  PairAdvance(const Body& P, const Track& tp, const Body& F, const Track& tf, double clearance,
              const KnownGap* known, const std::function<bool()>* keep_going)
      : P_(P), F_(F), tp_(tp), tf_(tf), clearance_(clearance), keep_going_(keep_going)
  {
    if (known != nullptr) gap_ = *known;
  }

  /// A part of the step, at most `limit`, over which the gap stays above `keep` > 0 times the smallest one
  /// seen at its start, which is not below the gap: nearly as far as it does.
  ///
  /// `remember`: where there is room to spare, more of the gap is certified than that, to be known later.
  double run(double limit, double keep, bool remember)
  {
    double s = 0.0, tau = limit;
    begin(s, limit);
    if (remember && speed_ * limit <= spare * least_seen_ &&
        certified(limit, std::max(keep, remembered)) == limit)
      return limit;
    for (int k = 0; k < most_advances && s < limit; ++k) {
      if (k > 0) begin(s, limit - s);
      tau = certified(std::min(tau, limit - s), k == 0 ? keep : 0.0);
      if (tau <= 0.0) return s;
      s += tau;
      if (tau < worth_going_on * s) return s;
      tau *= 2.0;
    }
    return s;
  }

  /// Closest points that it took.
  long evaluations() const { return evaluations_; }

  /// What is known of the gap after `run`.
  KnownGap found() && { return std::move(gap_); }

 private:
  /// Of the whole step; smaller advances are not worth their cost.
  static constexpr double smallest_advance = 1e-7;
  /// A pair that ends a step does so where its gap has become small, and that place is approached ever more
  /// slowly. An advance by less than this part of what is behind it is the last one.
  static constexpr double worth_going_on = 0.125;
  /// What is certified of gaps to be remembered, where the whole motion is below that part of them.
  static constexpr double remembered = 0.5, spare = 0.25;
  static constexpr int most_advances = 4000;
  static constexpr double smallest_panel = 1e-9;  ///< radians
  /// Closest points that one pair is worth: conforming surfaces near contact could take any number. What is
  /// certified until then stands.
  static constexpr long most_evaluations = 2000000;

  void begin(double s, double left)
  {
    Pose pp = tp_.pose, pf = tf_.pose;
    Vec3 vp = tp_.velocity, vf = tf_.velocity;
    if (s > 0.0) {
      tp_.at(s, pp, vp);
      tf_.at(s, pf, vf);
    }
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
    move_to({P_, pp, F_, pf}, left);
    looked_.clear();
    if (gap_.panels.empty()) {
      look_everywhere(probe);
    } else if (s == 0.0) {
      look_up(probe, 0, looked_);  // the target is a part of what is seen
    }
    least_seen_ = std::numeric_limits<double>::infinity();
    for (const PanelField& p : looked_) least_seen_ = std::min(least_seen_, gap_at(probe, p));
  }

  /// Takes what is known to where the bodies are; forgets it where more panels than a search from scratch
  /// looks at may close over the time `left`. Along lines a search is cheaper by half than its panels, each
  /// of which is split once on the way.
  void move_to(const RelativePlace& now, double left)
  {
    if (!gap_.panels.empty()) {
      const double lost = gap_.place.farthest(now, P_.bound);
      for (KnownPanel& p : gap_.panels) p.gap -= lost;
      const auto worth = static_cast<std::size_t>(dim == 1 ? gap_.from_scratch / 2 : gap_.from_scratch);
      if (worth < gap_.panels.size() && gap_.panels[worth].gap < speed_ * left) gap_.panels.clear();
    }
    gap_.place = now;
  }

  /// Begins with nothing known, by the first panels.
  void look_everywhere(const Probe<dim>& probe)
  {
    const FirstPanels<dim> first(probe);
    looked_.reserve(most_together * static_cast<std::size_t>(first.rows()));
    for (int k = 0; k < first.rows(); ++k) {
      std::array<PanelField, most_together> row = first.row(k);
      fill_fields(*frame_.F, row);
      looked_.insert(looked_.end(), row.begin(), row.end());
    }
    // All are of one size: the nearest have the lowest bounds.
    std::sort(looked_.begin(), looked_.end(),
              [](const PanelField& a, const PanelField& b) { return a.f.m.phi < b.f.m.phi; });
    for (const PanelField& p : looked_)
      gap_.panels.push_back({p.s, gap_at(probe, p) - panel_size(probe, p.s).first});
    gap_.from_scratch = 0;
    before_ = evaluations_;
    evaluations_ += static_cast<long>(looked_.size());
  }

  /// The fields of up to four known panels from the k-th on.
  void look_up(const Probe<dim>& probe, std::size_t k, std::vector<PanelField>& out)
  {
    out.resize(std::min(most_together, gap_.panels.size() - k));
    for (PanelField& p : out) {
      p.s = gap_.panels[k++].s;
      p.u = Angle(p.s.u);
      if constexpr (dim == 2) p.v = Angle(p.s.v);
      p.q = probe.at(p.u, p.v);
    }
    fill_fields(*frame_.F, out);
    evaluations_ += static_cast<long>(out.size());
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
    if (keep > 0.0) target_ = keep * least_seen_;
    split_.clear();
    std::size_t k = 0;  // of the known panels
    bool holding = true;
    while (holding && k < gap_.panels.size()) {
      if (looked_.empty()) {
        // All that follow have higher bounds.
        if (gap_.panels[k].gap - speed_ * tau >= std::max(target_, touching_)) break;
        look_up(probe, k, looked_);
      }
      for (std::size_t j = 0; holding && j < looked_.size(); ++j)
        holding = holds(probe, looked_[j], gap_.panels[k++].gap, tau, keep);
      looked_.clear();
    }
    replace_first(k);
    if (gap_.from_scratch == 0) gap_.from_scratch = evaluations_ - before_;
    return holding ? tau : 0.0;
  }

  /// Puts what the first k panels were split into in their place.
  void replace_first(std::size_t k)
  {
    const auto lower = [](const KnownPanel& a, const KnownPanel& b) { return a.gap < b.gap; };
    std::sort(split_.begin(), split_.end(), lower);
    merged_.clear();
    merged_.reserve(split_.size() + gap_.panels.size() - k);
    std::merge(split_.begin(), split_.end(), gap_.panels.begin() + static_cast<std::ptrdiff_t>(k),
               gap_.panels.end(), std::back_inserter(merged_), lower);
    gap_.panels.swap(merged_);
  }

  double gap_at(const Probe<dim>& probe, const PanelField& p) const
  {
    return p.f.m.phi - probe.offset - clearance_;
  }

  /// True where a panel, whose gap is at least `bound`, holds for the time tau, which it may halve. What it
  /// was split into, itself if it was not, is added to `split_` in any case.
  bool holds(const Probe<dim>& probe, PanelField& p, double bound, double& tau, double keep)
  {
    const double gap = gap_at(probe, p);
    least_seen_ = std::min(least_seen_, gap);
    if (keep > 0.0) target_ = std::min(target_, keep * gap);
    const auto leave = [&](bool held) {
      split_.push_back({p.s, bound});
      return held;
    };
    if (gap <= std::max(target_, touching_)) return leave(false);
    Verdict verdict = look(probe, p, tau, bound);
    while (verdict == Verdict::too_long) {
      tau *= 0.5;
      if (tau < smallest_advance || given_up()) return leave(false);
      verdict = look(probe, p, tau, bound);
    }
    if (verdict == Verdict::holds) return leave(true);
    if (leaves_a_rest(probe, p)) split_.push_back({rest_of(p), std::max(bound, target_)});
    std::array<PanelField, 2> half = split(probe, p);
    evaluations_ += 2;
    poll(keep_going_, ++splits_);
    const std::size_t first = half[1].f.m.phi < half[0].f.m.phi ? 1 : 0;  // nearer first
    const bool held = holds(probe, half[first], bound, tau, keep);
    if (held) return holds(probe, half[1 - first], bound, tau, keep);
    split_.push_back({half[1 - first].s, bound});
    return false;
  }

  bool given_up() const { return evaluations_ >= most_evaluations; }

  enum class Verdict { holds, too_wide, too_long };

  /// What of a strip is outside of its window.
  static Panel rest_of(const PanelField& p)
  {
    return {p.s.u, in_turn(p.s.v + std::numbers::pi), p.s.hu, all_around - p.half};
  }

  /// Whether a panel's gap stays above the target for the time tau. Raises `bound`, which its gap at the
  /// beginning is not below. Of a strip only the window is left to be looked at, which is entered.
  Verdict look(const Probe<dim>& probe, PanelField& p, double tau, double& bound) const
  {
    if constexpr (dim == 2) {
      if (is_strip(p.s)) {
        const double shift = probe.offset + clearance_;
        const StripWindow window = strip_window(probe, p.s, p.q, p.f, target_ + shift, strip_motion(p, tau));
        p.half = window.half;
        bound = std::max(bound, StripBound(probe, p.s, p.q, p.f, StripMotion{}).bound() - shift);
        if (window.half == 0.0) return Verdict::holds;
        double inside = -std::numeric_limits<double>::infinity();
        const Verdict verdict = look_at(probe, p, tau, inside);
        bound = std::max(bound, window.half < all_around ? std::min(inside, target_) : inside);
        return verdict;
      }
    }
    return look_at(probe, p, tau, bound);
  }

  /// What the motion over the time tau may do to a strip's window.
  StripMotion strip_motion(const PanelField& p, double tau) const
  {
    const Motion motion = motion_of(p.q, p.f);
    return {tau * motion.velocity, tau * (wp_ - wf_), 0.5 * acceleration_ * tau * tau};
  }

  /// The same of the part of a panel that may be near.
  Verdict look_at(const Probe<dim>& probe, const PanelField& p, double tau, double& bound) const
  {
    const Panel s = p.near();
    const ProbePoint& q = p.q;
    const FieldValue& f = p.f;
    const double g = gap_at(probe, p) - f.doubt;
    const double travel = speed_ * tau;
    const PanelSize size = panel_size(probe, s);
    const double d = size.first;
    bound = std::max(bound, g - d);
    if (g - d - travel >= target_) return Verdict::holds;

    const Motion motion = motion_of(q, f);
    const double time = std::max(0.0, -motion.rate) * tau + 0.5 * acceleration_ * tau * tau;
    const double rho = f.rho - d - travel;  // the field's Hessian is nowhere below -1/rho
    if (rho > 0.0) {
      double slope = std::abs(f.n.dot(q.pu)) * s.hu;
      if constexpr (dim == 2) slope += std::abs(f.n.dot(q.pv)) * s.hv;
      const double second = size.second + (d + travel) * (d + travel) / rho;
      bound = std::max(bound, g - slope - 0.5 * (size.second + d * d / rho));
      if (g - slope - time - angular_ * d * tau - 0.5 * second >= target_) return Verdict::holds;
    }
    const PanelSize path = path_size(size, tau);
    const auto stays = [&](const FieldValue& of, const FieldCurvature& field, double bent = 0.0) {
      const double left = g - bent - lost(motion, of, field, path, tau);
      if (left < target_) return false;
      const double least = least_to_second_order(probe, s, q, of);
      if (left + least - mixed(q, of, motion, s, tau) < target_) return false;
      bound = std::max(bound, g + least - third_order(field, size) - bent);
      return true;
    };
    const bool solid = !frame_.F->is_torus() && rho > 0.0;
    if (solid && stays(flattened(f), flat_curvature, 0.5 * path.first * path.first / rho))
      return Verdict::holds;
    if (frame_.F->is_ellipse()) {
      const RolledField rolled(*frame_.F, f);
      if (stays(rolled.f, rolled.curvature(path.first))) return Verdict::holds;
    }
    if (stays(f, field_curvature(*frame_.F, f, path.first))) return Verdict::holds;

    // Time alone already fails: a shorter advance is needed.
    const double alone = rho > 0.0 ? time + 0.5 * travel * travel / rho : travel;
    const PanelSize moved = path_size({}, tau);
    const bool flat_holds = solid && g - lost(motion, flattened(f), flat_curvature, moved, tau) -
                                             0.5 * moved.first * moved.first / rho >=
                                         target_;
    if (!flat_holds && g - std::min(alone, travel) < target_ &&
        g - lost(motion, f, field_curvature(*frame_.F, f, moved.first), moved, tau) < target_)
      return Verdict::too_long;
    return s.hu < smallest_panel || given_up() ? Verdict::too_long : Verdict::too_wide;
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

  /// What the terms of the field's expansion in u and t, and in v and t, may take off it over a panel and a
  /// time tau.
  double mixed(const ProbePoint& q, const FieldValue& f, const Motion& motion, const Panel& s,
               double tau) const
  {
    double cross = std::abs(mixed_derivative(f, q.pu, motion, true)) * s.hu * tau;
    if constexpr (dim == 2)
      cross += std::abs(mixed_derivative(f, q.pv, motion, frame_.difference == nullptr)) * s.hv * tau;
    return cross;
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
  const std::function<bool()>* keep_going_;
  long evaluations_ = 0, splits_ = 0;
  KnownGap gap_;           ///< where `begin` was last, which `certified` makes better
  long before_ = 0;        ///< evaluations at the last search from scratch
  double least_seen_ = 0;  ///< smallest gap at a centre of a panel that was looked at since `begin`
  double target_ = 0.0;    ///< what the gap has to stay above
  double touching_ = 0.0;  ///< what of a gap is rounding
  PairFrame frame_{P_, Pose{}, F_, Pose{}};
  Vec3 v_, wp_, wf_, of_;
  double speed_ = 0.0, angular_ = 0.0, acceleration_ = 0.0;
  double origins_ = 0.0;                    ///< the part of the acceleration that the elements' origins have
  double jerk_ = 0.0;                       ///< bound of the third derivative, origins moving evenly
  std::vector<PanelField> looked_;          ///< those of the known panels that are looked at next
  std::vector<KnownPanel> split_, merged_;  ///< see `holds`, `replace_first`
};

}  // namespace hauberk
