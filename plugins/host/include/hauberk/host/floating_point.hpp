#pragma once
/// The part of the floating-point environment that changes results: rounding, flush-to-zero, trapped
/// exceptions. Status flags are not part of it: any arithmetic sets them.

#include <cstdint>
#include <string>

namespace hauberk {

/// Control words of the calling thread's floating-point unit.
struct FloatingPointMode {
  std::uint64_t main = 0;    ///< x86: MXCSR control bits; ARM: FPCR; elsewhere: rounding mode
  std::uint64_t legacy = 0;  ///< x86: x87 control word; elsewhere: 0

  bool operator==(const FloatingPointMode&) const = default;
};

/// Reads the mode. A few nanoseconds.
FloatingPointMode floating_point_mode();

/// Sets the mode of the calling thread, keeps its status flags.
void set_floating_point_mode(const FloatingPointMode& mode);

/// What differs, in words: "flush-to-zero", "rounding", "trapped exceptions", joined by commas.
std::string describe_change(const FloatingPointMode& before, const FloatingPointMode& after);

}  // namespace hauberk
