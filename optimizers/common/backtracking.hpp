#pragma once
/// Lengths of the trial steps of a line search.

#include <algorithm>

namespace hauberk {

/// Part of the predicted decrease that a step must bring (Armijo).
inline constexpr double sufficient_decrease = 1e-4;
/// A shorter step is this much shorter, at least and at most; and after an evaluation that failed.
inline constexpr double least_cut = 0.5;
inline constexpr double largest_cut = 0.1;
inline constexpr double failure_cut = 0.25;
/// Trial points of one search; each costs an evaluation.
inline constexpr int max_trials = 12;

/// Minimum of the parabola through merit(0) with slope, and merit(alpha) = merit(0) + rise, kept within the
/// cuts.
inline double shorter(double alpha, double slope, double rise)
{
  const double curvature = rise - slope * alpha;
  const double minimum = curvature > 0.0 ? -0.5 * slope * alpha * alpha / curvature : least_cut * alpha;
  return std::clamp(minimum, largest_cut * alpha, least_cut * alpha);
}

}  // namespace hauberk
