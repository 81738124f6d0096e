/// Google Benchmark's own options apply. Exit code 2: no benchmark matches, or a wrong option.

#include "benchmarks.hpp"
#include "measure.hpp"

#include <hauberk/version.hpp>

#include <cstdio>

int main(int argc, char** argv)
{
  using namespace hauberk;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("version", version);
  benchmark::AddCustomContext("compiler", HAUBERK_BENCH_COMPILER);
  benchmark::AddCustomContext("build_type", build_type);
  benchmark::AddCustomContext("flags", HAUBERK_BENCH_FLAGS);

  bench::Scenes scenes;
  // What is left of this one's spread after calibration is what calibration cannot remove.
  bench::enter("calibration", [](benchmark::State& state) {
    bench::measure(state, [] { return [] { benchmark::DoNotOptimize(bench::fixed_loop()); }; });
  });
  bench::register_pairs(scenes);
  bench::register_energies(scenes);
  bench::register_limits(scenes);
  bench::register_designs(scenes);
  const std::size_t count = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (count == 0) std::fputs("bench: no benchmark matches the filter\n", stderr);
  return count == 0 ? 2 : 0;
}
