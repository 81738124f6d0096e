#pragma once
/// What a run takes at least, counted before anything is computed, and what it may take.

#include "limits/plan.hpp"

#include <string>

namespace hauberk {

/// Lower bounds, but for a task that may end sooner than its settings allow.
struct Work {
  double searches = 0.0;
  double evaluations = 0.0;  ///< of closest points
  double bytes = 0.0;        ///< of memory that is needed at the same time

  Work times(double count) const { return {searches * count, evaluations * count, bytes}; }
};

/// Of `searches` from states of the planned scene: each evaluates every pair that is near at rest at least
/// once in every stage, and keeps the states at the ends of its stages.
Work work_of(const Plan& plan, double searches);

/// "12 searches, at least 4.6e+03 evaluations of closest points and 0.1 MB of memory"
std::string text_of(const Work& work);

/// What a run may take unless it is asked for more.
struct Budget {
  double evaluations = 1e10;  ///< at 1e6 a second about three hours, of a lower bound
  double bytes = 0.0;         ///< 0: what this process may use
};

/// Throws InputError where the work is more than the budget, with both.
void refuse_beyond(const Budget& budget, const Work& work);

}  // namespace hauberk
