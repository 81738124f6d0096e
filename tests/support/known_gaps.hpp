#pragma once
/// Whether what collision checks leave behind is true.

#include "motion/gap_bounds.hpp"

#include <random>
#include <string>

namespace hauberk::test {

/// What was looked at, and what was wrong with it; empty where nothing was.
struct KnownGapCheck {
  long panels = 0;
  long positive = 0;  ///< of which the bound says that they are open
  std::string wrong;
};

/// Looks at all that is known of bodies that are near in a state: panels come by rising bound, every place of
/// the probe set lies in one, and no gap on a panel, at 5 places of a line and 25 of a surface, is below its
/// bound less what has moved. Places by the kernel's own distance, which has tests of its own.
KnownGapCheck check_known_gaps(const Model& model, const GapBounds& bounds, const State& state,
                               std::mt19937_64& rng);

}  // namespace hauberk::test
