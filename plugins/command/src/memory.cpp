#include "memory.hpp"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace hauberk::command {
namespace {

constexpr std::int64_t kibi = 1024;

}  // namespace

std::int64_t peak_memory_bytes()
{
  // ru_maxrss survives exec: it tells the size of whoever started the program, if that was larger. VmHWM is
  // of this program alone.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::int64_t size = 0;
    if (word == "VmHWM:" && status >> size) return size * kibi;
  }
  struct rusage usage = {};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::int64_t>(usage.ru_maxrss) * kibi : 0;
}

}  // namespace hauberk::command
