#pragma once
/// Deterministic parallel loops: which thread does an item never changes its result.

#include <cstddef>
#include <functional>

namespace hauberk {

/// What a number of threads asked for means: itself, and of 0 as many as the machine has.
unsigned thread_count(unsigned threads);

/// Calls body(i) for i in [0, count) on up to `threads` threads (`thread_count`). Every item
/// is done exactly once; the first exception by item order is rethrown after all threads have stopped.
void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& body);

}  // namespace hauberk
