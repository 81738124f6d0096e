#pragma once
/// The searches from rest with which a computation of limits begins: those of every limit that is asked for,
/// and of limits in its company, which are not reported and whose states teach.

#include "limits/limits.hpp"

#include <cstddef>
#include <vector>

namespace hauberk {

/// How one limit is searched from rest.
struct RestSearches {
  LimitTask task;
  std::size_t starts = 1;
  bool narrow = false;   ///< the last of the starts is that without the widest stage
  bool sparing = false;  ///< in company of taut limits alone, it may not cost more than their `allowance`
};

/// Evaluations of closest points that a search may have which begins again for a taut limit (is_taut), or is
/// in its company, where one from rest took `evaluations`: few of them lead further, those in few steps,
/// and a fabric that is folded takes thousands to draw taut.
long allowance(long evaluations);

/// Those that are asked for, in their order, then their company, as far as limits learn from each other and
/// `settings.neighbours` is not 0; only limits that links bound have company and are company.
///
/// Beside: a limit at an angle that has no other of its sense within `settings.neighbours` has two at that
/// angle to either side; of compressions of periodic cells these have a quarter of its starts. Taut limits
/// have them as far as they learn from them (learns_beside). Across: a taut limit that begins again has the
/// other sense at right angles.
std::vector<RestSearches> rest_searches(const Model& model, const std::vector<LimitTask>& tasks,
                                        const LimitSettings& settings);

}  // namespace hauberk
