#include "measure.hpp"

#include <array>
#include <cmath>
#include <ctime>

namespace hauberk::bench {
namespace {

/// Processor time of this thread, the clock that Google Benchmark uses for its cpu_time.
double thread_seconds()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

void enter(const std::string& name, const std::function<void(benchmark::State&)>& run)
{
#ifndef __clang_analyzer__  // takes what the library keeps for a leak, in the library's header
  benchmark::RegisterBenchmark(name.c_str(), run);
#endif
}

double fixed_loop()
{
  constexpr int rounds = 150000;
  std::array<double, 4> x{0.3, 0.7, 1.1, 1.5};  // independent chains, as the lanes of a panel are
  for (int k = 0; k < rounds; ++k) {
    for (double& v : x) v = std::sqrt(1.0 + v * (0.9 * v + 0.1)) / (1.0 + 0.3 * v * v);
  }
  return x[0] + x[1] + x[2] + x[3];
}

double calibrate()
{
  const double begin = thread_seconds();
  benchmark::DoNotOptimize(fixed_loop());
  return thread_seconds() - begin;
}

}  // namespace hauberk::bench
