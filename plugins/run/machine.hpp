#pragma once
#include "results/document.hpp"

namespace hauberk {

/// The processor as /proc/cpuinfo names it, how many there are, and the load average of the last minute.
/// Thread safe.
Machine this_machine();

}  // namespace hauberk
