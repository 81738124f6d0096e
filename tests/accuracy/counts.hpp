#pragma once
/// How many random cases the accuracy programs try. The defaults keep the folder quick; the published table
/// (share/doc/accuracy.md) states the counts it was made with.

#include <cstdlib>
#include <string>

namespace hauberk::brute {

/// Value of the environment variable `name`, or `otherwise` when it is not set.
inline long count(const char* name, long otherwise)
{
  const char* text = std::getenv(name);
  return text != nullptr ? std::stol(text) : otherwise;
}

inline long pair_count() { return count("HAUBERK_ACCURACY_PAIRS", 1200); }
inline long motion_count() { return count("HAUBERK_ACCURACY_MOTIONS", 40); }
inline long search_starts() { return count("HAUBERK_ACCURACY_STARTS", 1); }

}  // namespace hauberk::brute
