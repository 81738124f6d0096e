#pragma once
/// What is known of a limit beyond its state: which searches ended there, and which relations hold.

#include "limits/donors.hpp"

namespace hauberk {

/// Values that differ by more than their error estimates and this (scaled) are different.
inline constexpr double compared_to = 1e-7;

/// Fills the confidence of a limit whose state is that of `found[best]` from all that was found, and the
/// `distinct` states among it.
void enter_searches(Confidence& out, const Model& model, const LimitTask& task, const LimitSettings& settings,
                    const std::vector<FoundState>& found, std::size_t best,
                    const std::vector<LockedState>& distinct);

/// Compares limits that must agree, and enters into the confidence of each what confirms and what contradicts
/// it:
/// - limits of directions that a symmetry of the scene carries to each other are equal;
/// - a state that keeps all that a limit holds is no further along its load.
/// A limit whose state came from the other one confirms nothing. Beyond rounding, values without an error
/// estimate are compared to the gap that the last stage leaves.
void enter_relations(std::vector<LimitResult>& results, const Model& model, const LimitSettings& settings,
                     const std::vector<LimitTask>& tasks, const Donors& donors);

}  // namespace hauberk
