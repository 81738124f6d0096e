#pragma once
/// Measuring beside a fixed loop, so that runs of differently loaded machines can be compared.

#include <benchmark/benchmark.h>

#include <exception>
#include <functional>
#include <string>

namespace hauberk::bench {

/// Adds a benchmark to those that the program runs.
void enter(const std::string& name, const std::function<void(benchmark::State&)>& run);

/// Some milliseconds of double arithmetic, division and roots like the distance fields', always the same and
/// none of the project's code. The result depends on all of it.
double fixed_loop();

/// Processor seconds that one `fixed_loop` takes this thread now.
double calibrate();

/// Names of counters. Work is what must not grow and does not depend on the machine; results are what was
/// computed; the calibration is the time of the fixed loop just before and after.
namespace counter {
inline constexpr const char* evaluations = "evaluations";   ///< work: closest-point evaluations
inline constexpr const char* newton = "newton_iterations";  ///< work; "iterations" are Google Benchmark's
inline constexpr const char* pairs = "pairs";               ///< work: pairs of elements looked at
inline constexpr const char* value = "value";               ///< result: of the limit, or the objective
inline constexpr const char* error = "error";               ///< result: relative, of 1 + value
inline constexpr const char* calibration = "calibration";   ///< seconds
}  // namespace counter

/// Repeats what `prepare` returns as often as the benchmark asks, between two calibrations. What either
/// throws is the benchmark's error.
template <class Prepare>
void measure(benchmark::State& state, Prepare&& prepare)
try {
  auto body = prepare();
  const double before = calibrate();
  for ([[maybe_unused]] auto _ : state) body();
  state.counters[counter::calibration] = 0.5 * (before + calibrate());
} catch (const std::exception& error) {
  state.SkipWithError(error.what());
}

}  // namespace hauberk::bench
