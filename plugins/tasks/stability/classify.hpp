#pragma once
/// From claims and checks to outcomes.

#include "tasks/stability/stability_results.hpp"

namespace hauberk {

/// Sets best_known, outcome and reason of every case from what it claims (status, value, slack), what the
/// independent check said (checked, check), and what is known (exact, solvable, all other cases of the same
/// scene, direction and sense).
///
/// - interrupted stays interrupted; refused, stalled and failed are honest failures;
/// - unbounded, not_attained and not_a_sheet are right where there is nothing to find, and silently wrong
/// elsewhere;
/// - a locked state is silently wrong where there is none to find, where the check contradicts it, and where
/// it is
///   further than the exact value; local where it falls short of the best known state; else verified.
///
/// The best known value is the exact one, or else the furthest checked one of all methods and members with
/// the same scene. A state falls short of it by more than map.tolerance of 1 + value and three times `slack`:
/// with forces f and gaps g, closing the gaps gains sum f g to first order (a force is the rate at which the
/// value falls with its gap); three times, because `arc` lists resultants whose gaps are the smallest of a
/// stretch of tube. So a state that is merely less converged is not called another one. Deterministic; the
/// order of cases does not matter.
void classify(StabilityMap& map);

}  // namespace hauberk
