#include "tasks/chart/chart_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hauberk {
namespace {

using Values = std::vector<std::optional<double>>;

std::string show(const std::optional<double>& x) { return x ? fmt::format("{:.17g}", *x) : "no value"; }

/// What two runs that should be the same differ in; empty where they are.
std::string difference(const PrecisionRun& run, const PrecisionRun& other)
{
  for (std::size_t k = 0; k < std::min(run.values.size(), other.values.size()); ++k) {
    if (run.values[k] != other.values[k])
      return fmt::format("limit {}: {} instead of {}", k, show(run.values[k]), show(other.values[k]));
  }
  if (run.values.size() != other.values.size())
    return fmt::format("{} limits instead of {}", run.values.size(), other.values.size());
  if (run.iterations != other.iterations || run.evaluations != other.evaluations)
    return fmt::format("{} Newton steps and {} evaluations instead of {} and {}", run.iterations,
                       run.evaluations, other.iterations, other.evaluations);
  return "";
}

/// What a run lacks that is known; empty where it lacks nothing.
std::string missing(const PrecisionScene& scene, const Values& values)
{
  if (values.size() != scene.limits.size())
    return fmt::format("{} limits expected, found {}", scene.limits.size(), values.size());
  for (std::size_t k = 0; k < std::min(scene.exact.size(), values.size()); ++k) {
    if (scene.exact[k] && !values[k])
      return fmt::format("{} has no value, known is {:.10g}",
                         limit_name(scene.limits[k].sense, scene.limits[k].direction), *scene.exact[k]);
  }
  return "";
}

/// A run of the same scene, method and setting, with however many threads; null before any.
const PrecisionRun* same_run(const PrecisionChart& chart, const PrecisionPoint& point, int& threads)
{
  if (point.first) return &*point.first;
  for (const PrecisionPoint& p : chart.points) {
    if (p.scene != point.scene || p.method != point.method || p.setting != point.setting || !p.first)
      continue;
    threads = p.threads;
    return &*p.first;
  }
  return nullptr;
}

void fail(PrecisionPoint& point, RowStatus status, std::string message)
{
  point.status = status;
  point.message = std::move(message);
}

std::optional<double> error_of(const PrecisionScene& scene, const Values& values)
{
  std::optional<double> worst;
  for (std::size_t k = 0; k < std::min(scene.exact.size(), values.size()); ++k) {
    const std::optional<double>& exact = scene.exact[k];
    if (!exact) continue;
    if (!values[k]) return std::nullopt;
    const double error = std::abs(*values[k] - *exact) / (1.0 + std::abs(*exact));
    worst = std::max(worst.value_or(0.0), error);
  }
  return worst;
}

/// A point as fronts see it.
struct Placed {
  PrecisionPoint* point = nullptr;
  double error = 0.0, seconds = 0.0, evaluations = 0.0;
};

/// Whether another one of the same scene and number of threads is at least as good in both, and better in
/// one.
bool is_beaten(const Placed& p, const std::vector<Placed>& all, double Placed::*cost)
{
  return std::any_of(all.begin(), all.end(), [&](const Placed& o) {
    return o.point->scene == p.point->scene && o.point->threads == p.point->threads && o.error <= p.error &&
           o.*cost <= p.*cost && (o.error < p.error || o.*cost < p.*cost);
  });
}

void find_fronts(std::vector<PrecisionPoint>& points)
{
  std::vector<Placed> placed;
  for (PrecisionPoint& p : points) {
    p.pareto = p.pareto_work = false;
    if (!p.error || p.seconds.empty()) continue;
    placed.push_back({&p, std::max(*p.error, least_error), *p.median_seconds(),
                      static_cast<double>(p.first->evaluations)});
  }
  for (const Placed& p : placed) {
    p.point->pareto = !is_beaten(p, placed, &Placed::seconds);
    p.point->pareto_work = !is_beaten(p, placed, &Placed::evaluations);
  }
}

}  // namespace

std::optional<double> PrecisionScene::floor() const
{
  if (!reference) return std::nullopt;
  std::optional<double> worst;
  for (std::size_t k = 0; k < std::min(exact.size(), reference->estimates.size()); ++k) {
    if (!exact[k]) continue;
    if (!reference->estimates[k]) return std::nullopt;
    worst = std::max(worst.value_or(0.0), *reference->estimates[k] / (1.0 + std::abs(*exact[k])));
  }
  return worst;
}

std::optional<double> PrecisionPoint::median_seconds() const
{
  if (seconds.empty()) return std::nullopt;
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

PrecisionRun precision_run(const std::vector<LimitResult>& limits, const std::vector<LimitResult>& unreported,
                           double seconds)
{
  PrecisionRun run;
  std::tie(run.status, run.message) = status_of(limits);
  run.seconds = seconds;
  for (const LimitResult& limit : limits) {
    const bool locked = limit.status == LimitStatus::locked;
    run.values.push_back(locked ? limit.value : std::nullopt);
    run.estimates.push_back(locked ? limit.error_estimate : std::nullopt);
    run.locked += locked ? 1 : 0;
  }
  for (const std::vector<LimitResult>* list : {&limits, &unreported}) {
    for (const LimitResult& limit : *list) {
      run.iterations += limit.iterations;
      run.evaluations += limit.evaluations;
    }
  }
  return run;
}

void enter_reference(PrecisionChart& chart, std::size_t scene, PrecisionRun run)
{
  PrecisionScene& s = chart.scenes[scene];
  const bool any =
      std::any_of(run.values.begin(), run.values.end(), [](const auto& v) { return v.has_value(); });
  std::string problem = run.status != RowStatus::done ? to_string(run.status) + ": " + run.message
                        : !any                        ? "no limit is locked"
                                                      : "";
  s.exact = problem.empty() ? run.values : Values{};
  s.reference = std::move(run);
  if (problem.empty()) return;
  for (PrecisionPoint& p : chart.points) {
    if (p.scene == scene) fail(p, RowStatus::failed, "nothing to compare with: the reference " + problem);
  }
}

void enter_run(PrecisionChart& chart, std::size_t point, PrecisionRun run)
{
  PrecisionPoint& p = chart.points[point];
  if (run.status == RowStatus::interrupted) return;
  int threads = p.threads;
  const PrecisionRun* same = same_run(chart, p, threads);
  const std::string other = same != nullptr ? difference(run, *same) : "";
  const std::string lacking = run.status == RowStatus::done ? missing(chart.scenes[p.scene], run.values) : "";
  if (run.seconds) p.seconds.push_back(*run.seconds);
  if (!other.empty()) {
    p.reproducible = false;
    const std::string than =
        threads == p.threads ? "the first one" : fmt::format("that with threads {}", threads);
    fail(p, RowStatus::failed, fmt::format("run {} differs from {}: {}", p.seconds.size(), than, other));
  } else if (run.status != RowStatus::done) {
    fail(p, run.status, run.message);
  } else if (!lacking.empty()) {
    fail(p, RowStatus::failed, lacking);
  } else if (p.seconds.size() >= static_cast<std::size_t>(chart.repeats)) {
    p.status = RowStatus::done;
  }
  if (!p.first) p.first = std::move(run);
  evaluate(chart);
}

void evaluate(PrecisionChart& chart)
{
  for (PrecisionPoint& p : chart.points) {
    p.error.reset();
    const bool fit = p.status == RowStatus::done || p.status == RowStatus::interrupted;
    if (fit && p.first) p.error = error_of(chart.scenes[p.scene], p.first->values);
  }
  find_fronts(chart.points);
}

std::vector<const PrecisionPoint*> shown_points(const PrecisionChart& chart, std::size_t scene)
{
  std::vector<const PrecisionPoint*> out;
  for (const PrecisionPoint& p : chart.points) {
    if (p.scene == scene && p.threads == chart.threads.front() && p.error) out.push_back(&p);
  }
  return out;
}

std::string point_name(const PrecisionChart& chart, const PrecisionPoint& point)
{
  const PrecisionMethod& method = chart.methods[point.method];
  std::string text = chart.scenes[point.scene].name + ", " + method.name;
  if (!method.settings[point.setting].empty()) text += ", " + method.settings[point.setting];
  if (chart.threads.size() > 1)
    text += fmt::format(", {} {}", point.threads, point.threads == 1 ? "thread" : "threads");
  return text;
}

}  // namespace hauberk
