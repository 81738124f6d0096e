#pragma once
/// The searches from rest with which a computation of limits begins: those of every limit that is asked for,
/// and of limits in its company, which are not reported and whose states teach.

#include "limits/limits.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace hauberk {

/// Activation distance (L) of the last stage of limits that are not reported, at least: they are solved for
/// where they lock, not for how far that is.
inline constexpr double last_of_unreported = 1e-3;

/// Of the starts of a limit that is reported, what one has that it learns from.
inline constexpr int share_of_unreported = 4;

/// How one limit is searched from rest.
struct RestSearches {
  LimitTask task;
  std::size_t starts = 1;
  bool narrow = false;           ///< the last of the starts is that without the widest stage
  std::size_t random_loads = 0;  ///< so many before it begin under a random load
  /// Where they do not agree: as many more starts; of taut limits, where elements that are not linked with
  /// each other bear it, loads that are tilted (further_searches.hpp).
  std::size_t further_starts = 0;
  /// Then, where some began under random loads: as many of these at a time, from the furthest state.
  std::size_t refolds = 0;
  /// Starts from this one on may not cost more than the `allowance`: of the taut limits in whose company it
  /// is, which have none that may cost more, or of its own starts before these.
  std::size_t sparing_from = std::numeric_limits<std::size_t>::max();
};

/// Evaluations of closest points that a search may have which begins again for a taut limit (is_taut), or is
/// in its company, where one from rest took `evaluations`: few of them lead further, those in few steps,
/// and a fabric that is folded takes thousands to draw taut.
long allowance(long evaluations);

/// Those that are asked for, in their order, then their company, as far as limits learn from each other and
/// `settings.neighbours` is not 0; only limits that links bound have company and are company.
///
/// Beside: a limit at an angle has one at `settings.neighbours` degrees on each side on which no other of its
/// sense is within that; compressions of periodic cells also one at half of it, likewise, and theirs have a
/// quarter of the starts. Taut limits have them as far as they learn from them (learns_beside). Across: a
/// taut limit that begins again has the other sense at right angles, and in small cells another start of its
/// own.
std::vector<RestSearches> rest_searches(const Model& model, const std::vector<LimitTask>& tasks,
                                        const LimitSettings& settings);

}  // namespace hauberk
