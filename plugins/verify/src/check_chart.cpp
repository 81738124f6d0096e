#include "chart_points.hpp"
#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// Errors below count as this one.
constexpr double least_error = 1e-16;

/// Largest |value - exact|/(1 + |exact|); null where a value that is known is missing.
std::optional<double> error_of(const Values& values, const Values& exact)
{
  std::optional<double> worst;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    if (!exact[k]) continue;
    if (k >= values.size() || !values[k]) return std::nullopt;
    worst = std::max(worst.value_or(0.0), std::abs(*values[k] - *exact[k]) / (1.0 + std::abs(*exact[k])));
  }
  return worst;
}

void check_error(const ChartPoint& p, const Values& exact, Sentences& problems)
{
  constexpr double rounding = 1e-12;  // relative: the same few operations
  const bool fit = p.status == "done" || (p.status == "interrupted" && !p.runs.empty());
  const std::optional<double> expected = fit ? error_of(p.values, exact) : std::nullopt;
  const bool same = expected.has_value() == p.error.has_value() &&
                    (!expected || std::abs(*expected - *p.error) <= rounding * *expected);
  if (!same)
    problems.push_back(fmt::format("error {} reported, {} from its values", show(p.error), show(expected)));
  if (p.status == "done" && !expected) problems.emplace_back("done, but without an error");
}

void check_seconds(const json::value& seconds, const ChartPoint& p, double repeats, Sentences& problems)
{
  const auto count = static_cast<double>(p.runs.size());
  if (p.status == "done" ? count != repeats : count > repeats)
    problems.push_back(fmt::format("{} runs, {:g} expected", p.runs.size(), repeats));
  if (p.runs.empty()) return;
  std::vector<double> sorted = p.runs;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  const double median = sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
  const std::string where = p.where + "/seconds";
  const auto compare = [&](const char* key, double expected) {
    const double found = number(member(seconds, key, where), where);
    if (found != expected)
      problems.push_back(fmt::format("seconds/{} {:g} reported, {:g} from its runs", key, found, expected));
  };
  compare("min", sorted.front());
  compare("median", median);
  compare("max", sorted.back());
}

/// No other point of the scene with as many threads is at least as good in both and better in one.
bool on_front(const ChartPoint& p, const std::vector<ChartPoint>& points, double (*cost)(const ChartPoint&))
{
  if (!p.error) return false;
  const auto error = [](const ChartPoint& q) { return std::max(*q.error, least_error); };
  return std::none_of(points.begin(), points.end(), [&](const ChartPoint& q) {
    if (!q.error || q.scene != p.scene || q.threads != p.threads) return false;
    return error(q) <= error(p) && cost(q) <= cost(p) && (error(q) < error(p) || cost(q) < cost(p));
  });
}

void check_fronts(const ChartPoint& p, const std::vector<ChartPoint>& points, Sentences& problems)
{
  const auto seconds = [](const ChartPoint& q) { return q.median.value_or(0.0); };
  const auto work = [](const ChartPoint& q) { return q.evaluations; };
  if (p.pareto != on_front(p, points, seconds)) problems.emplace_back("pareto is wrong");
  if (p.pareto_work != on_front(p, points, work)) problems.emplace_back("pareto_work is wrong");
}

/// Numbers of threads must not change anything but times.
void check_same(const ChartPoint& p, const std::vector<ChartPoint>& points, Sentences& problems)
{
  for (const ChartPoint& q : points) {
    if (&q == &p) return;
    if (q.scene != p.scene || q.method != p.method || q.setting != p.setting || q.values.empty()) continue;
    const bool same = q.values == p.values && q.evaluations == p.evaluations && q.iterations == p.iterations;
    if (!same && !p.values.empty() && p.reproducible)
      problems.push_back(fmt::format("not what {} gave with {:g} threads", q.where, q.threads));
  }
}

std::string joined(const Sentences& problems) { return fmt::format("{}", fmt::join(problems, "; ")); }

/// What points of a scene are compared with, by name; absent: not known.
std::optional<Values> exact_of(const json::array& scenes, const std::string& name)
{
  for (const json::value& scene : scenes) {
    if (text(member(scene, "name", "/chart/scenes"), "/chart/scenes") != name) continue;
    const json::value& exact = member(scene, "exact", "/chart/scenes");
    if (!exact.is_null()) return read_values(exact, "/chart/scenes/exact");
  }
  return std::nullopt;
}

}  // namespace

void check_chart(const json::value& experiment, const json::value& chart, std::vector<VerifyLine>& lines,
                 Record& record)
{
  const json::value& asked = member(experiment, "chart", "/experiment");
  const json::array& scenes = array(member(chart, "scenes", "/chart"), "/chart/scenes");
  const json::array& entries = array(member(chart, "points", "/chart"), "/chart/points");
  const double repeats = number(member(asked, "repeats", "/experiment/chart"), "/experiment/chart/repeats");
  std::vector<ChartPoint> points;
  for (const json::value& entry : entries)
    points.push_back(read_chart_point(entry, fmt::format("/chart/points/{}", points.size())));
  Sentences table;
  check_chart_table(experiment, asked, chart, points, table);
  record.done(VerifyPart::chart, "/chart", table.empty());
  record.done(VerifyPart::chart, "/experiment/chart", table.empty());
  lines.push_back(
      {table.empty(),
       "/chart: " + (table.empty() ? fmt::format("{} points, as asked for", points.size()) : joined(table))});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ChartPoint& p = points[k];
    const std::string setting = p.setting.empty() ? "" : ", " + p.setting;
    const std::string name = fmt::format("{} ({}, {}{})", p.where, p.scene, p.method, setting);
    Sentences problems;
    const std::optional<Values> exact = exact_of(scenes, p.scene);
    check_error(p, exact.value_or(Values{}), problems);
    check_seconds(member(entries[k], "seconds", p.where), p, repeats, problems);
    check_fronts(p, points, problems);
    check_same(p, points, problems);
    check_locked(entries[k], p.values, p.where, problems);
    record.done(VerifyPart::chart, p.where, problems.empty());
    if (!problems.empty())
      lines.push_back({false, name + ": " + joined(problems)});
    else if (p.error)
      lines.push_back({true, fmt::format("{}: error {:.3g}, {} runs", name, *p.error, p.runs.size())});
    else
      lines.push_back({true, name + ": " + p.status + ", no error", false});
  }
}

}  // namespace hauberk::verification
