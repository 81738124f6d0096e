#include "chart_points.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

constexpr double rounding = 1e-14;  ///< of the same few operations

/// What the experiment asks for, in the order of the results.
struct Asked {
  std::string scene, method;
  double threads = 1.0;
};

bool solves(const json::value& method, const std::string& scene, const std::string& where)
{
  const json::value* scenes = method.as_object().if_contains("scenes");
  if (scenes == nullptr) return true;
  const json::array& list = array(*scenes, where + "/scenes");
  return std::any_of(list.begin(), list.end(), [&](const json::value& s) { return text(s, where) == scene; });
}

std::size_t setting_count(const json::value& method, const std::string& where)
{
  const json::value* vary = method.as_object().if_contains("vary");
  if (vary == nullptr) return 1;
  const json::array& entries = array(*vary, where + "/vary");
  if (entries.empty()) throw Malformed(where + "/vary: empty");
  return array(member(entries.front(), "values", where + "/vary/0"), where + "/vary/0/values").size();
}

std::vector<Asked> asked_points(const json::value& asked)
{
  const std::string where = "/experiment/chart";
  std::vector<Asked> out;
  for (const json::value& scene : array(member(asked, "scenes", where), where + "/scenes")) {
    const std::string name = text(member(scene, "name", where + "/scenes"), where + "/scenes");
    for (const json::value& method : array(member(asked, "methods", where), where + "/methods")) {
      const std::string by = text(member(method, "name", where + "/methods"), where + "/methods");
      if (!solves(method, name, where + "/methods")) continue;
      for (std::size_t k = 0; k < setting_count(method, where + "/methods"); ++k) {
        for (const json::value& threads : array(member(asked, "threads", where), where + "/threads"))
          out.push_back({name, by, number(threads, where + "/threads")});
      }
    }
  }
  return out;
}

void check_points(const json::value& asked, const std::vector<ChartPoint>& points, Sentences& problems)
{
  const std::vector<Asked> expected = asked_points(asked);
  if (expected.size() != points.size()) {
    problems.push_back(fmt::format("points: {} expected, found {}", expected.size(), points.size()));
    return;
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Asked& e = expected[k];
    const ChartPoint& p = points[k];
    if (e.scene != p.scene || e.method != p.method || e.threads != p.threads)
      problems.push_back(
          fmt::format("points/{}: '{}' by '{}' with {:g} threads expected", k, e.scene, e.method, e.threads));
    for (std::size_t j = 0; j < k; ++j) {
      if (points[j].scene == p.scene && points[j].method == p.method && points[j].setting == p.setting &&
          points[j].threads == p.threads)
        problems.push_back(fmt::format("points/{}: the same as points/{}", k, j));
    }
  }
}

/// Largest error estimate of the reference, relative to 1 + |value|; null where one has none.
void check_floor(const Values& exact, const json::value& reference, const json::value& scene,
                 const std::string& where, Sentences& problems)
{
  std::optional<double> floor;
  if (!reference.is_null()) {
    const Values estimates =
        read_values(member(reference, "error_estimates", where + "/reference"), where + "/reference");
    bool all = estimates.size() == exact.size();
    for (std::size_t k = 0; all && k < exact.size(); ++k) {
      if (!exact[k]) continue;
      all = estimates[k].has_value();
      if (all) floor = std::max(floor.value_or(0.0), *estimates[k] / (1.0 + std::abs(*exact[k])));
    }
    if (!all) floor.reset();
  }
  const std::optional<double> recorded = optional_number(scene, "floor", where);
  if (!equal(recorded, floor, rounding))
    problems.push_back(
        fmt::format("{}/floor: {} recorded, {} from the reference", where, show(recorded), show(floor)));
}

/// Exact values are those of the experiment, or those of the reference where it has one.
void check_exact(const json::value& asked, const json::value& scene, const std::string& where,
                 Sentences& problems)
{
  const json::value& exact = member(scene, "exact", where);
  const json::value& reference = member(scene, "reference", where);
  if (text(member(asked, "name", where), where) != text(member(scene, "name", where), where))
    problems.push_back(where + ": not the scene that the experiment has there");
  const json::value* given = asked.as_object().if_contains("exact");
  Values expected;
  if (given == nullptr) {
    if (exact.is_null()) return;  // it is not done, or has failed
    expected = read_values(member(reference, "values", where + "/reference"), where + "/reference/values");
  } else {
    expected = given->is_array() ? read_values(*given, where + "/exact") : Values{number(*given, where)};
  }
  if (exact.is_null() || read_values(exact, where + "/exact") != expected)
    problems.push_back(where + "/exact: not what the experiment or the reference says");
  check_floor(expected, reference, scene, where, problems);
}

}  // namespace

void check_chart_table(const json::value& experiment, const json::value& chart,
                       const std::vector<ChartPoint>& points, Sentences& problems)
{
  const std::string where = "/experiment/chart/scenes";
  check_points(experiment, points, problems);
  std::vector<std::string> statuses;
  statuses.reserve(points.size());
  for (const ChartPoint& p : points) statuses.push_back(p.status);
  check_counts(member(chart, "counts", "/chart"), statuses, "points", problems);
  const json::array& asked = array(member(experiment, "scenes", "/experiment/chart"), where);
  const json::array& scenes = array(member(chart, "scenes", "/chart"), "/chart/scenes");
  if (scenes.size() != asked.size())
    problems.push_back(fmt::format("scenes: {} expected, found {}", asked.size(), scenes.size()));
  for (std::size_t k = 0; k < std::min(scenes.size(), asked.size()); ++k)
    check_exact(asked[k], scenes[k], fmt::format("/chart/scenes/{}", k), problems);
}

}  // namespace hauberk::verification
