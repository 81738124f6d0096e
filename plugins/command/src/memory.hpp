#pragma once
/// How much memory this process has needed.

#include <cstdint>

namespace hauberk::command {

/// Largest resident size of this process so far, in bytes; 0 where the system does not tell. It differs from
/// run to run, as times do. Thread safe.
std::int64_t peak_memory_bytes();

}  // namespace hauberk::command
