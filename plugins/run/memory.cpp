#include "run/memory.hpp"

#include <sys/resource.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <fstream>
#include <string>

namespace hauberk {
namespace {

constexpr std::int64_t kibi = 1024;

/// An entry of /proc/self/status, in bytes.
std::optional<std::int64_t> status_bytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::int64_t size = 0;
    if (word == name && status >> size) return size * kibi;
  }
  return std::nullopt;
}

/// Linux: the largest resident size is from now on that since now.
bool forget_peak()
{
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5" << std::flush;
  return reset.good();
}

}  // namespace

std::int64_t peak_memory_bytes()
{
  // ru_maxrss survives exec: it tells the size of whoever started the program, if that was larger. VmHWM is
  // of this program alone.
  if (const std::optional<std::int64_t> peak = status_bytes("VmHWM:")) return *peak;
  struct rusage usage = {};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::int64_t>(usage.ru_maxrss) * kibi : 0;
}

MemoryMeter::MemoryMeter()
{
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
  if (forget_peak()) before_ = status_bytes("VmRSS:");
}

std::optional<std::int64_t> MemoryMeter::peak() const
{
  const std::optional<std::int64_t> peak = status_bytes("VmHWM:");
  if (!before_ || !peak) return std::nullopt;
  return std::max<std::int64_t>(*peak - *before_, 0);
}

}  // namespace hauberk
