#pragma once
/// Moves elements apart until there is room between them.

#include "model/model.hpp"

#include <functional>
#include <string>

namespace hauberk {

/// Outcome of `relax`.
struct Relaxed {
  State state;
  bool moved = false;
  double smallest = 0.0;        ///< smallest gap afterwards
  double largest_motion = 0.0;  ///< L
  std::string problem;          ///< empty when every gap reached the target and links are kept
};

/// Whether the macroscopic unknowns may move too.
enum class Cell { fixed, free };

inline constexpr int most_relaxations = 200;  ///< iterations

/// Nearest state with room: minimises 1/2 sum over close pairs of max(0, target - g)^2 + eps/2 |y - y0|^2
/// by Levenberg-Marquardt, y all unknowns, y0 those of `start`. Elements may overlap at the start (not deeper
/// than their tubes). Throws Interrupted where `keep_going` says no, which is asked in every iteration.
Relaxed relax(
    const Model& model, const State& start, double target, Cell cell = Cell::fixed,
    int most_iterations = most_relaxations, const std::function<bool()>& keep_going = [] { return true; });

}  // namespace hauberk
