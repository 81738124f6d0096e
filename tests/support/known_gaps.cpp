#include "known_gaps.hpp"

#include "geometry/panel_field.hpp"
#include "model/near_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace hauberk::test {
namespace {

using std::numbers::pi;

double gap_at(const PairFrame& frame, double u, double v, double clearance)
{
  const auto of = [&](const auto& probe) {
    return field_at(*frame.F, probe.at(u, v).p).m.phi - probe.offset - clearance;
  };
  return probe_dimension(frame) == 2 ? of(Probe<2>(frame)) : of(Probe<1>(frame));
}

double smallest_on(const PairFrame& frame, const Panel& s, double clearance)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j)
      least = std::min(least, gap_at(frame, s.u + 0.5 * i * s.hu, s.v + 0.5 * j * s.hv, clearance));
  }
  return least;
}

bool holds_place(const Panel& s, double u, double v, int dimension)
{
  const auto within = [](double x, double middle, double half) {
    return std::abs(std::remainder(x - middle, 2.0 * pi)) <= half * (1.0 + 1e-12);
  };
  return within(u, s.u, s.hu) && (dimension == 1 || within(v, s.v, s.hv));
}

void check_pair(const PairFrame& frame, const KnownGap& known, double lost, double clearance,
                std::mt19937_64& rng, KnownGapCheck& out)
{
  double last = -std::numeric_limits<double>::infinity();
  for (const KnownPanel& p : known.panels) {
    ++out.panels;
    out.positive += p.gap > lost ? 1 : 0;
    if (p.gap < last) out.wrong += fmt::format("{} after {}; ", p.gap, last);
    last = p.gap;
    const double least = smallest_on(frame, p.s, clearance);
    if (p.gap - lost > least + 1e-14) out.wrong += fmt::format("{} - {} above {}; ", p.gap, lost, least);
  }
  std::uniform_real_distribution<double> angle(0.0, 2.0 * pi);
  for (int k = 0; k < 20; ++k) {
    const double u = angle(rng), v = angle(rng);
    const bool held = std::any_of(known.panels.begin(), known.panels.end(), [&](const KnownPanel& p) {
      return holds_place(p.s, u, v, probe_dimension(frame));
    });
    if (!held) out.wrong += fmt::format("({}, {}) is on no panel; ", u, v);
  }
}

}  // namespace

KnownGapCheck check_known_gaps(const Model& m, const GapBounds& bounds, const State& s, std::mt19937_64& rng)
{
  KnownGapCheck out;
  for (const ElementPair& pair : near_pairs(m, s, 0.2)) {
    const Pose pi = image_pose(m, s, pair.i, {}), pj = image_pose(m, s, pair.j, pair.image);
    const std::size_t i = pair.i, j = pair.j;
    for (int a = m.first_body[i]; a < m.first_body[i + 1]; ++a) {
      for (int b = m.first_body[j]; b < m.first_body[j + 1]; ++b) {
        const KnownGap* known = bounds.known(a, b, pair.image);
        if (known == nullptr) continue;
        const Body &A = m.bodies[a], &B = m.bodies[b];
        const PairFrame frame = second_probes(A, B) ? PairFrame(B, pj, A, pi) : PairFrame(A, pi, B, pj);
        check_pair(frame, *known, known->lost(A, pi, B, pj), m.clearance, rng, out);
      }
    }
  }
  return out;
}

}  // namespace hauberk::test
