#include "tasks/chart/chart_run.hpp"
#include "run/interrupt.hpp"
#include "run/limit_tasks.hpp"
#include "run/memory.hpp"
#include "run/variant_run.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <chrono>

namespace hauberk {
namespace {

using Clock = std::chrono::steady_clock;

/// A run that gave nothing, and why.
PrecisionRun no_run(RowStatus status, const std::string& message)
{
  PrecisionRun run;
  run.status = status;
  run.message = message;
  return run;
}

/// Prepares and solves a variant; only the solve is timed. `before` is called right before it, `after` right
/// after.
PrecisionRun timed_run(const Experiment& experiment, unsigned threads, const std::function<void()>& before,
                       const std::function<void()>& after)
try {
  const PreparedVariant prepared = prepare_variant(experiment);
  if (before) before();
  const Clock::time_point begin = Clock::now();
  const VariantLimits solved = solve_variant(prepared, threads);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (after) after();
  return precision_run(solved.limits, solved.unreported, seconds);
} catch (const InputError& error) {
  return no_run(RowStatus::refused, error.what());
} catch (const std::exception& error) {
  return no_run(RowStatus::failed, error.what());
}

void run_references(const LoadedChart& loaded, unsigned threads, Progress& progress, PrecisionChart& chart,
                    const ChartObserver& observer)
{
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < chart.scenes.size(); ++k) {
    if (chart.scenes[k].has_reference && !chart.scenes[k].reference) left.push_back(k);
  }
  if (left.empty()) return;
  progress.limits("reference", 0, left.size());
  for (std::size_t k = 0; k < left.size() && !interrupted(); ++k) {
    PrecisionRun run = timed_run(*loaded.scenes[left[k]], threads, {}, {});
    if (run.status == RowStatus::interrupted) return;
    enter_reference(chart, left[k], std::move(run));
    progress.limits("reference", k + 1, left.size());
    if (observer.on_run) observer.on_run(chart);
  }
}

/// One more run of a point.
void run_point(const ChartItem& item, PrecisionChart& chart, std::size_t k, const ChartObserver& observer)
{
  if (!item.experiment) return enter_run(chart, k, no_run(RowStatus::refused, item.refusal));
  const auto threads = static_cast<unsigned>(chart.points[k].threads);
  if (!chart.points[k].seconds.empty())
    return enter_run(chart, k, timed_run(*item.experiment, threads, {}, {}));
  std::optional<MemoryMeter> meter;
  std::optional<std::int64_t> peak;
  PrecisionRun run = timed_run(
      *item.experiment, threads,
      [&] {
        if (observer.before_memory) observer.before_memory();
        meter.emplace();
      },
      [&] { peak = meter->peak(); });
  if (run.status != RowStatus::interrupted) chart.points[k].peak_memory_bytes = peak;
  enter_run(chart, k, std::move(run));
}

/// Runs that are left to do.
std::size_t runs_left(const PrecisionChart& chart)
{
  std::size_t left = 0;
  for (const PrecisionPoint& point : chart.points) {
    if (point.status == RowStatus::interrupted)
      left += static_cast<std::size_t>(chart.repeats) - point.seconds.size();
  }
  return left;
}

}  // namespace

PrecisionChart empty_chart(const ExperimentChart& from, const LoadedChart& loaded)
{
  PrecisionChart chart;
  chart.repeats = from.repeats;
  chart.threads = from.threads;
  for (std::size_t k = 0; k < from.scenes.size(); ++k) {
    const ChartScene& scene = from.scenes[k];
    const Experiment& e = loaded.scenes[k].value();
    PrecisionScene& entry = chart.scenes.emplace_back();
    entry.name = scene.name;
    entry.exact = scene.exact;
    entry.has_reference = scene.reference.has_value();
    for (const LimitTask& task : profile_tasks(e))
      entry.limits.push_back({task.direction, e.load_case->sense_name(task.direction, task.sense)});
  }
  for (const ChartMethod& method : from.methods) chart.methods.push_back({method.name, method.labels});
  for (const ChartItem& item : loaded.items) {
    for (const int threads : from.threads) {
      PrecisionPoint& point = chart.points.emplace_back();
      point.scene = item.scene;
      point.method = item.method;
      point.setting = item.setting;
      point.threads = threads;
    }
  }
  return chart;
}

void run_chart(const LoadedChart& loaded, unsigned threads, Progress& progress, PrecisionChart& chart,
               const ChartObserver& observer)
{
  run_references(loaded, threads, progress, chart, observer);
  const std::size_t total = runs_left(chart);
  progress.limits("chart", 0, total);
  for (std::size_t repeat = 0; repeat < static_cast<std::size_t>(chart.repeats); ++repeat) {
    for (std::size_t k = 0; k < chart.points.size(); ++k) {
      if (interrupted()) return;
      const PrecisionPoint& point = chart.points[k];
      if (point.status != RowStatus::interrupted || point.seconds.size() > repeat) continue;
      run_point(loaded.items[k / chart.threads.size()], chart, k, observer);
      if (interrupted()) return;
      progress.limits("chart", total - runs_left(chart), total);
      if (observer.on_run) observer.on_run(chart);
    }
  }
}

bool any_failed(const PrecisionChart& chart)
{
  return std::any_of(chart.scenes.begin(), chart.scenes.end(),
                     [](const PrecisionScene& scene) { return scene.reference && scene.exact.empty(); }) ||
         std::any_of(chart.points.begin(), chart.points.end(),
                     [](const PrecisionPoint& point) { return !point.reproducible; });
}

}  // namespace hauberk
