#include "tasks/chart/chart_run.hpp"

#include "run/interrupt.hpp"
#include "run/limit_tasks.hpp"
#include "run/memory.hpp"
#include "run/variant_run.hpp"
#include "tasks/variants/grid.hpp"

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
{
  const PreparedVariant prepared = prepare_variant(experiment);
  if (before) before();
  const Clock::time_point begin = Clock::now();
  const VariantLimits solved = solve_variant(prepared, threads);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (after) after();
  return precision_run(solved.limits, solved.unreported, seconds);
}

/// Scenes that are compared with a solve of higher accuracy, one by one.
class References final : public GridRows {
 public:
  References(const LoadedChart& loaded, unsigned threads, PrecisionChart& chart)
      : loaded_(loaded), threads_(threads), chart_(chart)
  {
  }

  /// Scenes whose reference is not known.
  std::vector<std::size_t> left() const
  {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < chart_.scenes.size(); ++k) {
      if (chart_.scenes[k].has_reference && !chart_.scenes[k].reference) out.push_back(k);
    }
    return out;
  }

  const VariantReading& variant(std::size_t scene) const override { return loaded_.scenes[scene]; }

  EnterRow solve(std::size_t scene, const Experiment& e) override
  {
    return entry(scene, timed_run(e, threads_, {}, {}));
  }

  EnterRow refuse(std::size_t scene, RowStatus status, const std::string& message) override
  {
    return entry(scene, no_run(status, message));
  }

 private:
  EnterRow entry(std::size_t scene, PrecisionRun run)
  {
    if (run.status == RowStatus::interrupted) return {};
    return [this, scene, run = std::move(run)]() -> std::size_t {
      enter_reference(chart_, scene, run);
      return 1;
    };
  }

  const LoadedChart& loaded_;
  unsigned threads_;
  PrecisionChart& chart_;
};

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

/// One more run of every point, one point at a time with the point's own number of threads.
class PointRuns final : public GridRows {
 public:
  PointRuns(const LoadedChart& loaded, const std::function<void()>& note_peak_memory, PrecisionChart& chart)
      : loaded_(loaded), note_peak_memory_(note_peak_memory), chart_(chart)
  {
  }

  /// Points that have at most `repeat` runs and are not done.
  std::vector<std::size_t> left(std::size_t repeat) const
  {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < chart_.points.size(); ++k) {
      const PrecisionPoint& point = chart_.points[k];
      if (point.status == RowStatus::interrupted && point.seconds.size() <= repeat) out.push_back(k);
    }
    return out;
  }

  const VariantReading& variant(std::size_t point) const override
  {
    return loaded_.items[point / chart_.threads.size()].reading;
  }

  EnterRow solve(std::size_t point, const Experiment& e) override
  {
    const auto threads = static_cast<unsigned>(chart_.points[point].threads);
    if (!chart_.points[point].seconds.empty()) return entry(point, timed_run(e, threads, {}, {}), {});
    std::optional<MemoryMeter> meter;
    std::optional<std::int64_t> peak;
    PrecisionRun run = timed_run(
        e, threads,
        [&] {
          if (note_peak_memory_) note_peak_memory_();
          meter.emplace();
        },
        [&] { peak = meter->peak(); });
    return entry(point, std::move(run), peak);
  }

  EnterRow refuse(std::size_t point, RowStatus status, const std::string& message) override
  {
    return entry(point, no_run(status, message), {});
  }

 private:
  EnterRow entry(std::size_t point, PrecisionRun run, std::optional<std::int64_t> peak)
  {
    if (run.status == RowStatus::interrupted) return {};
    return [this, point, run = std::move(run), peak] {
      const std::size_t before = runs_left(chart_);
      if (peak) chart_.points[point].peak_memory_bytes = peak;
      enter_run(chart_, point, run);
      return before - runs_left(chart_);
    };
  }

  const LoadedChart& loaded_;
  const std::function<void()>& note_peak_memory_;
  PrecisionChart& chart_;
};

}  // namespace

PrecisionChart empty_chart(const ExperimentChart& from, const LoadedChart& loaded)
{
  PrecisionChart chart;
  chart.repeats = from.repeats;
  chart.threads = from.threads;
  for (std::size_t k = 0; k < from.scenes.size(); ++k) {
    const ChartScene& scene = from.scenes[k];
    const Experiment& e = loaded.scenes[k].experiment.value();
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

void run_chart(const LoadedChart& loaded, RunContext& context, PrecisionChart& chart)
{
  References references(loaded, context.threads, chart);
  if (const std::vector<std::size_t> left = references.left(); !left.empty())
    Grid(context, "reference", left.size()).run(references, left, 1);
  if (interrupted()) return;
  PointRuns runs(loaded, context.note_peak_memory, chart);
  Grid grid(context, "chart", runs_left(chart));
  for (std::size_t repeat = 0; repeat < static_cast<std::size_t>(chart.repeats); ++repeat)
    grid.run(runs, runs.left(repeat), 1);
}

bool any_failed(const PrecisionChart& chart)
{
  return std::any_of(chart.scenes.begin(), chart.scenes.end(),
                     [](const PrecisionScene& scene) { return scene.reference && scene.exact.empty(); }) ||
         std::any_of(chart.points.begin(), chart.points.end(),
                     [](const PrecisionPoint& point) { return !point.reproducible; });
}

}  // namespace hauberk
