#pragma once
/// How much room a fabric has: how far apart its linked elements can be at the same time.

#include "equilibrium/relaxation.hpp"
#include "limits/limits.hpp"

#include <vector>

namespace hauberk {

/// One local maximum of the smallest gap.
struct RoomyState {
  State state;
  double gap = 0.0;  ///< smallest gap, scaled; minus infinity for a start that has lost links
  std::uint64_t seed = 0;
};

/// What the search found.
struct Room {
  RoomyState best;
  std::vector<double> gaps;  ///< of every start, in their order, scaled; as RoomyState::gap
};

/// How it is searched.
struct RoomSettings {
  Cell cell = Cell::free;     ///< whether the strain is searched, too
  int starts = 1;             ///< the first as at rest, the others perturbed
  double perturbation = 0.3;  ///< L
  std::uint64_t seed = 1;
  double resolution = 1e-10;  ///< of the gap, L: where growing ends
};

/// Maximises the smallest gap of the model over poses and, with Cell::free, strains:
///
///     max over y of min over pairs k of g_k(y), links kept,
///
/// by asking `relax` for a larger gap again and again, with steps that grow where it succeeds and shrink
/// where it does not, down to `resolution`. A local maximum: `relax` fails where no small motion opens all of
/// the closest gaps. A tube whose surface is everywhere g/2 farther out is the same tube, thicker: the
/// largest gap is what a fabric of these rings can be thickened by before it has no rest state.
///
/// Elements may overlap at the start, not deeper than their tubes. Starts are done in parallel; the result
/// does not depend on `threads`. Throws what the load case throws.
Room find_room(const Model& model, const RoomSettings& settings, unsigned threads,
               const KeepGoing& keep_going);

}  // namespace hauberk
