#include <hauberk/verify/verify.hpp>

#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <exception>

namespace hauberk {
namespace {

namespace json = boost::json;
using namespace verification;

constexpr const char* known_format = "hauberk-results/1";

/// Checks the limits of one scene, a line each; those that could be read are returned.
std::vector<Limit> check_limits(const Scene& scene, const json::value& limits_json, const std::string& prefix,
                                const Setting& setting, const VerifyTolerances& tolerances,
                                std::vector<VerifyLine>& lines)
{
  std::vector<Limit> out;
  std::size_t i = 0;
  for (const json::value& item : array(limits_json, prefix + "/limits")) {
    const std::string where = fmt::format("{}/limits/{}", prefix, i++);
    try {
      Limit limit = read_limit(item, setting.load, where);
      const std::string direction = limit.direction
                                        ? fmt::format("({:.6g})", fmt::join(*limit.direction, ", "))
                                        : fmt::format("{:g} deg", limit.direction_deg);
      limit.label = fmt::format("{} ({}, {})", where, direction, limit.sense);
      lines.push_back(check_limit(scene, setting, limit, tolerances));
      out.push_back(std::move(limit));
    } catch (const Malformed& error) {
      lines.push_back({false, error.what()});
    }
  }
  return out;
}

Malformed wrong_cell(const std::string& prefix)
{
  return Malformed(
      prefix +
      "/scene/cell_vectors: two for in_plane_periodic, three for volumetric_periodic, none for a patch");
}

/// One document's limits, and profiles where it has any limit; `prefix` is its place in the file.
void check_scene_and_limits(const json::value& results, const std::string& prefix,
                            const VerifyTolerances& tolerances, std::vector<VerifyLine>& lines)
{
  const Setting setting = read_setting(member(results, "experiment", prefix));
  Scene scene = read_scene(member(results, "scene", prefix), prefix + "/scene");
  for (Element& element : scene.elements)
    for (Torus& torus : element.tori) {
      torus.facets = setting.facets;
      if (torus.surface && setting.facets == 0)
        throw Malformed(prefix +
                        "/experiment/solver/contact: mesh expected, as the scene has triangle meshes");
    }
  if (scene.cell.size() != cell_dimension(setting.load)) throw wrong_cell(prefix);
  check_length(scene, scene.length, prefix + "/scene");
  const auto limits =
      check_limits(scene, member(results, "limits", prefix), prefix, setting, tolerances, lines);
  const auto add = [&](VerifyLine line) {
    if (!prefix.empty()) line.text = prefix + ": " + line.text;
    lines.push_back(std::move(line));
  };
  add(check_profiles(results, setting.load, limits, tolerances));
  if (const json::value* boundary = results.as_object().if_contains("boundary")) {
    const bool complete = limits.size() == member(results, "limits", prefix).as_array().size();
    add(check_boundary(*boundary, limits, complete, tolerances));
  }
}

/// A swept number stands in the row's experiment, where its pointer leads there (those of a weave do not: it
/// has been replaced by what it stands for).
void check_placed(const json::value& axis, const json::value& value, const json::value& experiment,
                  const std::string& where)
{
  if (!value.is_number()) return;
  for (const json::value& place : array(member(axis, "places", where), where)) {
    const std::string pointer = text(member(place, "pointer", where), where);
    json::error_code none;
    const json::value* found = experiment.find_pointer(pointer, none);
    if (found == nullptr) continue;
    const double expected = number(member(place, "factor", where), where) * number(value, where) +
                            number(member(place, "offset", where), where);
    if (number(*found, where) != expected)
      throw Malformed(fmt::format("{}: the row's experiment has {} at {}, the table says {}", where,
                                  number(*found, where), pointer, expected));
  }
}

/// What is recorded of a row is what its results say.
void check_measured(const json::value& measures, const json::value& row, const json::value& result,
                    const std::string& where)
{
  for (const json::value& measure : array(measures, "/sweep/measures")) {
    const std::string name = text(member(measure, "name", where), where);
    json::error_code none;
    const json::value* found = result.find_pointer(text(member(measure, "pointer", where), where), none);
    const json::value& recorded = member(member(row, "measured", where), name.c_str(), where);
    const bool same = found != nullptr && found->is_number() ? recorded == *found : recorded.is_null();
    if (!same) throw Malformed(fmt::format("{}/measured: '{}' is not what the results say", where, name));
  }
}

/// Every row that has results, each with a scene of its own.
void check_sweep(const json::value& sweep, const VerifyTolerances& tolerances, std::vector<VerifyLine>& lines)
{
  const json::array& axes = array(member(sweep, "axes", "/sweep"), "/sweep/axes");
  std::size_t k = 0;
  for (const json::value& row : array(member(sweep, "rows", "/sweep"), "/sweep/rows")) {
    const std::string where = fmt::format("/sweep/rows/{}", k++);
    const json::value& result = member(row, "result", where);
    const std::string status = text(member(row, "status", where), where);
    if (result.is_null()) {
      // Only a row that is done must have any; whether the status is one at all the table tells.
      lines.push_back({status != "done", where + ": " + status + ", no results", false});
      continue;
    }
    try {
      for (const json::value& axis : axes) {
        const std::string name = text(member(axis, "name", "/sweep/axes"), "/sweep/axes");
        check_placed(axis, member(member(row, "values", where), name.c_str(), where),
                     member(result, "experiment", where + "/result"), where);
      }
      check_measured(member(sweep, "measures", "/sweep"), row, result, where);
      check_scene_and_limits(result, where + "/result", tolerances, lines);
    } catch (const Malformed& error) {
      lines.push_back({false, error.what()});
    }
  }
}

void check_document(const json::value& results, const VerifyTolerances& tolerances,
                    std::vector<VerifyLine>& lines)
{
  if (!results.is_object() || !results.as_object().contains("format"))
    throw Malformed("/format: missing; these are no results: give the results.json that `hauberk run` wrote");
  if (const std::string format = text(member(results, "format", ""), "/format"); format != known_format)
    throw Malformed(fmt::format("/format: {} expected, found {}", known_format, format));
  const json::value& experiment = member(results, "experiment", "");
  const json::value* task = experiment.is_object() ? experiment.as_object().if_contains("task") : nullptr;
  if (task != nullptr && text(*task, "/experiment/task") == "sweep") {
    const json::value& sweep = member(results, "sweep", "");
    lines.push_back(check_sweep_table(experiment, sweep));
    return check_sweep(sweep, tolerances, lines);
  }
  if (task != nullptr && text(*task, "/experiment/task") == "chart")
    return check_chart(experiment, member(results, "chart", ""), lines);
  const json::value* none = results.as_object().if_contains("design");
  if (none != nullptr && none->is_null()) return check_scene_and_limits(results, "", tolerances, lines);

  const Setting setting = read_setting(experiment);
  const Scene scene = read_scene(member(results, "scene", ""), "/scene");
  if (scene.cell.size() != cell_dimension(setting.load)) throw wrong_cell("");
  const json::value& design = member(results, "design", "");
  const auto limits = check_limits(scene, member(results, "limits", ""), "", setting, tolerances, lines);
  lines.push_back(check_profiles(results, setting.load, limits, tolerances));
  const json::value& initial = member(design, "initial", "/design");
  const Scene initial_scene =
      read_scene(member(initial, "scene", "/design/initial"), "/design/initial/scene");
  check_length(initial_scene, initial_scene.length, "/design/initial/scene");
  check_length(initial_scene, scene.length, "/scene");  // frozen during the design
  const auto initial_limits = check_limits(initial_scene, member(initial, "limits", "/design/initial"),
                                           "/design/initial", setting, tolerances, lines);
  lines.push_back(check_design(results, initial_limits, limits, tolerances));
}

}  // namespace

std::string VerifyReport::text() const
{
  std::string out;
  for (const VerifyLine& line : lines)
    out += (!line.ok ? "FAIL " : line.checked ? "PASS " : "NONE ") + line.text + '\n';
  return out;
}

VerifyReport verify(const json::value& results, const VerifyTolerances& tolerances)
{
  VerifyReport report;
  try {
    check_document(results, tolerances, report.lines);
  } catch (const std::exception& error) {
    report.lines.push_back({false, error.what()});
  }
  if (report.lines.empty()) report.lines.push_back({false, "nothing in this file could be checked"});
  for (const VerifyLine& line : report.lines) report.ok = report.ok && line.ok;
  return report;
}

}  // namespace hauberk
