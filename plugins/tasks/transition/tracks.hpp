#pragma once
/// Which minimum of one sample of a path is which of the next.

#include "tasks/transition/transition_results.hpp"

#include <vector>

namespace hauberk {

/// Numbers contacts along a path, from 0: a minimum is the contact of the sample before whose points on both
/// elements are nearest to its own, as long as they moved less than `reach` (file units); otherwise it is a
/// new one. Where one minimum becomes two, the nearer of them keeps its number.
void number_contacts(std::vector<TransitionSample>& samples, double reach);

}  // namespace hauberk
