// A shape that would be good, but for a static constructor: CMake defines HOW it misbehaves while it is
// loaded.
#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace {

[[maybe_unused]] bool throws() { throw std::runtime_error("no licence"); }
[[maybe_unused]] bool crashes() { std::abort(); }
[[maybe_unused]] bool waits()
{
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}
[[maybe_unused]] bool moves() { return chdir("/") == 0; }

const bool ready = HOW();

}  // namespace

#define ALTERATION (void)table
#include "good_shape.cpp"  // NOLINT(bugprone-suspicious-include)
