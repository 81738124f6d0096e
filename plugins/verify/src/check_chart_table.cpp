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

/// Names of the settings: labels where there are any, and then as many as values.
void check_methods(const json::value& asked, const json::value& chart, Sentences& problems)
{
  const std::string where = "/chart/methods";
  const json::array& given =
      array(member(asked, "methods", "/experiment/chart"), "/experiment/chart/methods");
  const json::array& found = array(member(chart, "methods", "/chart"), where);
  if (given.size() != found.size()) return problems.push_back("methods: not the experiment's");
  for (std::size_t k = 0; k < given.size(); ++k) {
    const std::string at = fmt::format("{}/{}", where, k);
    const json::array& settings = array(member(found[k], "settings", at), at + "/settings");
    const json::value* labels = given[k].as_object().if_contains("labels");
    if (member(found[k], "name", at) != member(given[k], "name", at) ||
        settings.size() != setting_count(given[k], at) ||
        (labels != nullptr && *labels != json::value(settings)))
      problems.push_back(fmt::format("methods/{}: not the experiment's", k));
  }
}

/// Points of a method run through its settings.
void check_settings(const json::value& chart, const std::vector<ChartPoint>& points, Sentences& problems)
{
  for (const json::value& method : array(member(chart, "methods", "/chart"), "/chart/methods")) {
    const json::array& settings = array(member(method, "settings", "/chart/methods"), "/chart/methods");
    for (const ChartPoint& p : points) {
      if (json::value(p.method) != member(method, "name", "/chart/methods")) continue;
      if (std::find(settings.begin(), settings.end(), json::value(p.setting)) == settings.end())
        problems.push_back(fmt::format("{}: '{}' is no setting of '{}'", p.where, p.setting, p.method));
    }
    for (const json::value& setting : settings) {
      const std::string name = text(setting, "/chart/methods");
      if (std::none_of(points.begin(), points.end(), [&](const ChartPoint& p) { return p.setting == name; }))
        problems.push_back(fmt::format("methods: no point has the setting '{}'", name));
    }
  }
}

/// Sets what a pointer leads to, or adds a member.
void enter(json::value& v, std::string_view pointer, const json::value& value)
{
  json::error_code none;
  if (json::value* found = v.find_pointer(pointer, none))
    *found = value;
  else if (json::object* object = v.if_object();
           object != nullptr && pointer.find('/', 1) == std::string_view::npos)
    (*object)[pointer.substr(1)] = value;
}

/// The experiment's load case with what a scene sets in it.
json::value load_case_of(const json::value& experiment, const json::value& asked)
{
  json::value load = member(experiment, "load_case", "/experiment");
  const json::value* set = asked.as_object().if_contains("set");
  if (set == nullptr || !set->is_object()) return load;
  constexpr std::string_view section = "/load_case";
  for (const auto& [pointer, value] : set->as_object()) {
    const std::string_view at = pointer;
    if (at == section) load = value;
    if (at.starts_with(section) && at.size() > section.size()) enter(load, at.substr(section.size()), value);
  }
  return load;
}

/// As many limits as values, each in a direction and a sense that are asked for.
void check_limits(const json::value& experiment, const json::value& asked, const json::value& scene,
                  const std::string& where, Sentences& problems)
{
  const json::array& limits = array(member(scene, "limits", where), where + "/limits");
  const json::value& exact = member(scene, "exact", where);
  if (exact.is_array() && exact.as_array().size() != limits.size())
    problems.push_back(where + "/limits: not as many as exact values");
  const json::value load = load_case_of(experiment, asked);
  const auto listed = [&](const char* key, const json::value& wanted) {
    const json::value* list = load.as_object().if_contains(key);
    if (list == nullptr || !list->is_array()) return true;
    return std::any_of(list->as_array().begin(), list->as_array().end(), [&](const json::value& x) {
      const bool named = x.is_string() && (x.as_string().starts_with('$') || x.as_string().starts_with('='));
      if (named && wanted.is_number()) return true;  // a named value, which rows may vary
      return x.is_number() && wanted.is_number() ? x.to_number<double>() == wanted.to_number<double>()
                                                 : x == wanted;
    });
  };
  for (const json::value& limit : limits) {
    if (!listed("senses", member(limit, "sense", where + "/limits")) ||
        !listed("directions_deg", member(limit, "direction_deg", where + "/limits")))
      problems.push_back(where + "/limits: one that is not asked for");
  }
}

bool known_row(const std::string& status)
{
  return status == "done" || status == "failed" || status == "refused" || status == "interrupted";
}

}  // namespace

void check_locked(const json::value& entry, const Values& values, const std::string& where,
                  Sentences& problems)
{
  const auto count = std::count_if(values.begin(), values.end(), [](const auto& v) { return v.has_value(); });
  if (number(member(entry, "locked", where), where + "/locked") != static_cast<double>(count))
    problems.push_back(fmt::format("{}/locked: {} expected", where, count));
}

void check_chart_table(const json::value& whole, const json::value& experiment, const json::value& chart,
                       const std::vector<ChartPoint>& points, Sentences& problems)
{
  const std::string where = "/experiment/chart/scenes";
  check_points(experiment, points, problems);
  std::vector<std::string> statuses;
  statuses.reserve(points.size());
  for (const ChartPoint& p : points) statuses.push_back(p.status);
  check_counts(member(chart, "counts", "/chart"), statuses, "points", problems);
  for (const char* key : {"repeats", "threads"})
    if (member(chart, key, "/chart") != member(experiment, key, "/experiment/chart"))
      problems.push_back(fmt::format("{}: not the experiment's", key));
  check_methods(experiment, chart, problems);
  check_settings(chart, points, problems);
  const json::array& asked = array(member(experiment, "scenes", "/experiment/chart"), where);
  const json::array& scenes = array(member(chart, "scenes", "/chart"), "/chart/scenes");
  if (scenes.size() != asked.size())
    problems.push_back(fmt::format("scenes: {} expected, found {}", asked.size(), scenes.size()));
  for (std::size_t k = 0; k < std::min(scenes.size(), asked.size()); ++k) {
    const std::string at = fmt::format("/chart/scenes/{}", k);
    check_exact(asked[k], scenes[k], at, problems);
    check_limits(whole, asked[k], scenes[k], at, problems);
    const json::value& reference = member(scenes[k], "reference", at);
    if (!reference.is_null() && !known_row(text(member(reference, "status", at), at)))
      problems.push_back(at + "/reference/status: not a known one");
    if (!reference.is_null())
      check_locked(reference, read_values(member(reference, "values", at), at), at + "/reference", problems);
  }
}

}  // namespace hauberk::verification
