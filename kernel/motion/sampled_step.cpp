#include "contact/published.hpp"
#include "motion/advancement.hpp"
#include "motion/track.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

constexpr double shorten = 0.9;  ///< paper, below equation (6)
/// A step shorter than this is no step.
constexpr double shortest = 1e-9;
constexpr int most_iterations = 12;  ///< of one minimisation over s
/// Relative decrease of the squared distance below which the minimisation over s ends.
constexpr double settled = 1e-6;

/// Squared distance of a pair along the step and its derivative.
struct Along {
  double d = 0.0, slope = 0.0;
};

class PairSearch {
 public:
  PairSearch(const Body& P, const Track& tp, const Body& F, const Track& tf, SafeStep& count)
      : P_(P), F_(F), tp_(tp), tf_(tf), count_(count)
  {
  }

  /// Smallest distance found over [0, most], equation (6), by projected secant steps in s from the end that
  /// is nearer: what L-BFGS-B does in one variable. Where the paper starts it is not said.
  double smallest(double most)
  {
    const Along first = at(0.0), last = at(most);
    double s = first.d < last.d ? 0.0 : most;
    Along now = first.d < last.d ? first : last;
    // A minimum between the ends lies where the distance falls into the interval from either of them.
    if (first.d < last.d ? first.slope >= 0.0 : last.slope <= 0.0) return std::sqrt(now.d);
    double curvature = std::max(std::abs(last.slope - first.slope) / most, 1e-300);
    for (int k = 0; k < most_iterations; ++k) {
      double next = std::clamp(s - now.slope / curvature, 0.0, most);
      Along there = at(next);
      for (int halvings = 0; there.d > now.d && halvings < 20; ++halvings) {
        next = 0.5 * (s + next);
        there = at(next);
      }
      if (!(there.d < now.d)) break;
      const double bend = (there.slope - now.slope) / (next - s);
      const double gain = now.d - there.d;
      s = next;
      now = there;
      if (bend > 0.0) curvature = bend;
      if (gain < settled * now.d) break;
    }
    return std::sqrt(now.d);
  }

 private:
  /// d(s) = min_c d(c, q + s dq) over the sampled closest points, and its derivative, equation (8):
  ///   (d_c c_q + d_q) dq/ds = d_q dq/ds = 2 (V_P - V_F) . (velocity of P's point - velocity of F's point),
  /// because d_c = 0 at the minimum.
  Along at(double s)
  {
    Pose pp, pf;
    Vec3 vp, vf;
    tp_.at(s, pp, vp);
    tf_.at(s, pf, vf);
    const PairFrame frame(P_, pp, F_, pf);
    int evaluations = 0;
    const auto minima = published::sampled_minima(frame, evaluations);
    count_.evaluations += evaluations;
    const published::PublishedMinimum& m = minima.front();
    const Frame wp = world_frame(P_, pp), wf = world_frame(F_, pf);
    const Vec3 a = wp.center + wp.axes * chart_point(P_, m.c[0], m.c[1]);
    const Vec3 b = wf.center + wf.axes * chart_point(F_, m.c[2], m.c[3]);
    const Vec3 velocity = vp + tp_.w.cross(a - pp.position) - vf - tf_.w.cross(b - pf.position);
    return {m.d, 2.0 * (a - b).dot(velocity)};
  }

  const Body& P_;
  const Body& F_;
  const Track& tp_;
  const Track& tf_;
  SafeStep& count_;
};

}  // namespace

SafeStep sampled_safe_step(const Model& m, const State& from, const Vector& dy, double least_gap)
{
  constexpr double keep_of_walls = 0.1;  // walls are linear and need no search
  SafeStep out;
  if (!std::all_of(m.bodies.begin(), m.bodies.end(), [](const Body& b) { return b.is_torus(); }))
    throw InputError(
        "ccd 'sampled' knows tori only, no tubes around curves, meshes or solids; use 'certified'");
  out.alpha = wall_step(m, from, dy, keep_of_walls);
  const std::vector<CandidatePair> candidates = candidate_pairs(m, from, dy);
  const auto for_each_pair = [&](auto&& visit) {
    for (const CandidatePair& pair : candidates) {
      const std::size_t i = pair.ti.element, j = pair.tj.element;
      for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
        for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
          const Body &A = m.bodies[a], &B = m.bodies[b];
          const double motion = pair.approach + pair.ti.w.norm() * A.reach + pair.tj.w.norm() * B.reach;
          const Vec3 ca = pair.ti.pose.position + pair.ti.pose.rotation * A.center;
          const Vec3 cb = pair.tj.pose.position + pair.tj.pose.rotation * B.center;
          if ((ca - cb).norm() - A.bound - B.bound - motion > m.clearance) continue;
          visit(pair, A, B, motion);
        }
      }
    }
  };
  // "Constraining the step size to be within the radii of the two tori" (paper, limitations).
  for_each_pair([&](const CandidatePair&, const Body& A, const Body& B, double motion) {
    const double radius = std::min({A.r0, A.r1, B.r0, B.r1});
    if (motion > 0.0) out.alpha = std::min(out.alpha, radius / motion);
  });
  for_each_pair([&](const CandidatePair& pair, const Body& A, const Body& B, double) {
    PairSearch search(A, pair.ti, B, pair.tj, out);
    bool first = true;
    while (out.alpha > 0.0 && search.smallest(out.alpha) - m.clearance <= least_gap) {
      if (first) ++out.tight_pairs;
      first = false;
      out.alpha = out.alpha > shortest ? shorten * out.alpha : 0.0;
    }
  });
  return out;
}

}  // namespace hauberk
