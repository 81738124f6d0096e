#include <hauberk/host/floating_point.hpp>

#include <cfenv>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace hauberk {
namespace {

#if defined(__x86_64__)
constexpr std::uint64_t status_flags = 0x3f;                  // MXCSR bits 0..5
constexpr std::uint64_t flush_bits = (1U << 15) | (1U << 6);  // FTZ and DAZ
constexpr std::uint64_t rounding_bits = 3U << 13;
#elif defined(__aarch64__)
constexpr std::uint64_t flush_bits = 1U << 24;
constexpr std::uint64_t rounding_bits = 3U << 22;
#else
constexpr std::uint64_t flush_bits = 0;
constexpr std::uint64_t rounding_bits = ~std::uint64_t{0};
#endif
// x87 control word; its precision control changes results as rounding does.
constexpr std::uint64_t legacy_rounding_bits = 0xf00;

}  // namespace

FloatingPointMode floating_point_mode()
{
  FloatingPointMode mode;
#if defined(__x86_64__)
  mode.main = _mm_getcsr() & ~status_flags;
  std::uint16_t control = 0;
  asm volatile("fnstcw %0" : "=m"(control));
  mode.legacy = control;
#elif defined(__aarch64__)
  asm volatile("mrs %0, fpcr" : "=r"(mode.main));
#else
  mode.main = static_cast<std::uint64_t>(std::fegetround());
#endif
  return mode;
}

void set_floating_point_mode(const FloatingPointMode& mode)
{
  if (mode == floating_point_mode()) return;  // writing is slow, and nearly always needless
#if defined(__x86_64__)
  _mm_setcsr(static_cast<unsigned>(mode.main | (_mm_getcsr() & status_flags)));
  const auto control = static_cast<std::uint16_t>(mode.legacy);
  asm volatile("fldcw %0" : : "m"(control));
#elif defined(__aarch64__)
  asm volatile("msr fpcr, %0" : : "r"(mode.main));
#else
  std::fesetround(static_cast<int>(mode.main));
#endif
}

std::string describe_change(const FloatingPointMode& before, const FloatingPointMode& after)
{
  const std::uint64_t main = before.main ^ after.main;
  const std::uint64_t legacy = before.legacy ^ after.legacy;
  std::string text;
  const auto add = [&](bool changed, const char* what) {
    if (changed) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add((main & flush_bits) != 0, "flush-to-zero");
  add((main & rounding_bits) != 0 || (legacy & legacy_rounding_bits) != 0, "rounding");
  add((main & ~(flush_bits | rounding_bits)) != 0 || (legacy & ~legacy_rounding_bits) != 0,
      "trapped exceptions");
  return text;
}

}  // namespace hauberk
