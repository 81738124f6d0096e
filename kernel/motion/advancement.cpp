#include "motion/advancement.hpp"

#include "motion/facet_advancement.hpp"
#include "motion/pair_advance.hpp"
#include "numerics/parallel.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace hauberk {
namespace {

/// Pairs of bodies from which on pairs are advanced together, and how many.
constexpr std::size_t large_scene = 128, taken_together = 16;

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
  const KnownGap* known;
  double alpha = 0.0;
  long evaluations = 0;
  std::optional<KnownGap> found = std::nullopt;
};

std::vector<BodyPair> body_pairs(const Model& m, const std::vector<CandidatePair>& candidates)
{
  std::vector<BodyPair> out;
  for (const CandidatePair& pair : candidates) {
    const std::size_t i = pair.ti.element, j = pair.tj.element;
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const Body& A = m.bodies[a];
        const Body& B = m.bodies[b];
        out.push_back(
            {&pair, a, b, A, B, pair.approach + pair.ti.w.norm() * A.reach + pair.tj.w.norm() * B.reach});
      }
    }
  }
  return out;
}

/// True if a surface that probes is inside of the body that it probes. A core that is probed knows the inside
/// of its own tube, and of a tube around a curve no field is known. Where all of a surface is inside of
/// another, so is any point of it.
bool inside(const PairFrame& frame)
{
  return probe_dimension(frame) == 2 && frame.difference == nullptr && !frame.F->curve &&
         field_at(*frame.F, Probe<2>(frame).at(0.0, 0.0).p).m.phi < 0.0;
}

/// Looks for the part of [0, alpha] over which a pair keeps that part of its gap.
void advance(Tight& tight, double clearance, double alpha, double keep, bool remember,
             const std::function<bool()>* keep_going)
{
  const BodyPair& bodies = *tight.bodies;
  const CandidatePair& pair = *bodies.pair;
  const Body &A = bodies.A, &B = bodies.B;
  const bool swap = second_probes(A, B);
  const Body &P = swap ? B : A, &F = swap ? A : B;
  const Track &tp = swap ? pair.tj : pair.ti, &tf = swap ? pair.ti : pair.tj;
  const Pose &pp = tp.pose, &pf = tf.pose;
  if (inside(PairFrame(P, pp, F, pf)) || inside(PairFrame(F, pf, P, pp))) return;
  const auto run = [&](auto pair_advance) {
    tight.alpha = pair_advance.run(alpha, keep, remember);
    tight.evaluations = pair_advance.evaluations();
    if (remember) tight.found = std::move(pair_advance).found();
  };
  if (probe_dimension(PairFrame(P, pp, F, pf)) == 1) {
    run(PairAdvance<1>(P, tp, F, tf, clearance, tight.known, keep_going));
  } else {
    run(PairAdvance<2>(P, tp, F, tf, clearance, tight.known, keep_going));
  }
}

}  // namespace

SafeStep largest_safe_step(const Model& m, const State& from, const Vector& dy, double keep, unsigned threads,
                           GapBounds* bounds, const std::function<bool()>* keep_going)
{
  SafeStep out;
  out.alpha = wall_step(m, from, dy, keep);
  const std::vector<CandidatePair> candidates = candidate_pairs(m, from, dy, keep_going);
  const std::vector<BodyPair> all = body_pairs(m, candidates);
  // What is found so far shortens the rest. In a large scene pairs are taken together, from the same alpha,
  // also by one thread, as the number of threads may not change what is found.
  const std::size_t most = all.size() >= large_scene ? taken_together : 1;
  std::vector<Tight> tight;
  const auto advance_all = [&] {
    parallel_for(tight.size(), threads, [&](std::size_t i) {
      advance(tight[i], m.clearance, out.alpha, keep, bounds != nullptr, keep_going);
    });
    for (Tight& t : tight) {
      if (t.found) bounds->remember(t.bodies->a, t.bodies->b, t.bodies->pair->tj.image, std::move(*t.found));
      out.alpha = std::min(out.alpha, t.alpha);
      out.evaluations += t.evaluations;
    }
    tight.clear();
  };
  for (std::size_t k = 0; k < all.size() && out.alpha > 0.0; ++k) {
    poll(keep_going, static_cast<long>(k));
    const BodyPair& bodies = all[k];
    const CandidatePair& pair = *bodies.pair;
    const Pose &pi = pair.ti.pose, &pj = pair.tj.pose;
    if (bodies.A.facets) {
      out.alpha =
          advance_facets(bodies.A, pair.ti, bodies.B, pair.tj, m.clearance, out.alpha, keep, out, keep_going);
      continue;
    }
    const auto far = [&](double apart) {
      return apart > 0.0 && (1.0 - keep) * apart >= out.alpha * bodies.motion;
    };
    if (far(ball_gap(bodies.A, pi, bodies.B, pj, m.clearance))) continue;
    const KnownGap* known = bounds != nullptr ? bounds->known(bodies.a, bodies.b, pair.tj.image) : nullptr;
    if (known != nullptr && far(known->at_least(bodies.A, pi, bodies.B, pj))) continue;
    ++out.tight_pairs;
    tight.push_back({&bodies, known});
    if (tight.size() == most) advance_all();
  }
  if (out.alpha > 0.0) advance_all();
  return out;
}

}  // namespace hauberk
