#include "limits/room.hpp"

#include "equilibrium/gaps.hpp"
#include "limits/room_polish.hpp"
#include "model/links.hpp"
#include "numerics/parallel.hpp"

#include <algorithm>
#include <limits>

namespace hauberk {
namespace {

/// First step of the gap, L; a tenth of a tube of usual thickness.
constexpr double first_step = 0.02;
constexpr double largest_step = 0.1;
/// Where less than this part of a step is gained, the step was too long.
constexpr double worth_a_step = 0.1;
constexpr int most_steps = 1000;
/// Range in which the smallest gap is looked for, L: tubes that far apart are no fabric.
constexpr double far = 4.0;

RoomyState grow(const Model& m, State state, const RoomSettings& settings, const KeepGoing& keep_going)
{
  RoomyState out{std::move(state), -std::numeric_limits<double>::infinity(), 0};
  if (!links_kept(m, out.state)) return out;  // of another fabric, however much room it has
  out.gap = smallest_gap(m, out.state, far);
  double step = first_step;
  for (int it = 0; it < most_steps && step >= settings.resolution && keep_going(); ++it) {
    const Relaxed r = relax(m, out.state, out.gap + step, settings.cell);
    const double gap =
        links_kept(m, r.state) && !meshes_meet(m, r.state) ? smallest_gap(m, r.state, far) : out.gap;
    const double gain = gap - out.gap;
    // What is gained counts also where it is less than was asked for.
    if (gain > 0.0) {
      out.state = r.state;
      out.gap = gap;
    }
    if (r.problem.empty()) {
      step = std::min(2.0 * step, largest_step);
    } else if (gain < worth_a_step * step) {
      step *= 0.5;
    }
  }
  out.state = polished_room(m, out.state, out.gap, settings.cell, keep_going);
  out.gap = smallest_gap(m, out.state, far);
  return out;
}

}  // namespace

Room find_room(const Model& m, const RoomSettings& settings, unsigned threads, const KeepGoing& keep_going)
{
  std::vector<RoomyState> found(std::max(settings.starts, 1));
  parallel_for(found.size(), threads, [&](std::size_t k) {
    const std::uint64_t seed = settings.seed + k;
    State from = rest_state(m);
    if (k > 0) from = perturbed(m, from, settings.perturbation, seed, Copies::apart);
    found[k] = grow(m, std::move(from), settings, keep_going);
    found[k].seed = seed;
  });
  Room out;
  for (const RoomyState& state : found) {
    out.gaps.push_back(state.gap);
    if (out.gaps.size() == 1 || state.gap > out.best.gap) out.best = state;
  }
  return out;
}

}  // namespace hauberk
