#pragma once
/// How much memory this process has needed.

#include <cstdint>
#include <optional>

namespace hauberk {

/// Largest resident size of this process so far, or since a MemoryMeter began, in bytes; 0 where the system
/// does not tell. It differs from run to run, as times do. Thread safe.
std::int64_t peak_memory_bytes();

/// What a stretch of the program needs beyond what the process has before. Memory that was freed is given
/// back first, where the C library can, so that it counts when it is needed again. Exact to some pages per
/// thread. One at a time.
class MemoryMeter {
 public:
  /// Forgets the peak so far: ask for it before.
  MemoryMeter();
  /// Bytes since then, at least 0; null where the system does not tell.
  std::optional<std::int64_t> peak() const;

 private:
  std::optional<std::int64_t> before_;
};

}  // namespace hauberk
