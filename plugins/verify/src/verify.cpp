#include "checks.hpp"
#include "read.hpp"

#include <hauberk/verify/verify.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>
#include <utility>

namespace hauberk {
namespace {

namespace json = boost::json;
using namespace verification;

constexpr const char* known_format = "hauberk-results/2";

/// What all checks of a document share.
struct Work {
  const VerifyTolerances& tolerances;
  Record& record;
  std::vector<VerifyLine>& lines;
  const VerifyShapes& shapes;

  /// Messages about malformed fields begin with their pointer.
  void malformed(const std::string& what) const
  {
    record.failed(what.substr(0, what.find(':')));
    lines.push_back({false, what});
  }
};

/// Checks the limits of one scene, a line each; those that could be read are returned.
std::vector<Limit> check_limits(const Scene& scene, const json::value& limits_json, const std::string& prefix,
                                const Setting& setting, const json::value& experiment, const Work& work)
{
  std::vector<Limit> out;
  std::size_t i = 0;
  for (const json::value& item : array(limits_json, prefix + "/limits")) {
    const std::string where = fmt::format("{}/limits/{}", prefix, i++);
    Limit limit;
    try {
      limit = read_limit(item, setting.load, where);
      const std::string direction = limit.direction
                                        ? fmt::format("({:.6g})", fmt::join(*limit.direction, ", "))
                                        : fmt::format("{:g} deg", limit.direction_deg);
      limit.label = fmt::format("{} ({}, {})", where, direction, limit.sense);
      work.lines.push_back(
          check_limit(scene, setting, limit, item, experiment, work.tolerances, work.shapes, work.record));
      out.push_back(std::move(limit));
    } catch (const Malformed& error) {
      work.record.skip(where, "limits that cannot be read");
      work.malformed(error.what());
    } catch (const Unknown& error) {
      work.record.skip(where, error.what());
      work.lines.push_back({true, limit.label + ": " + error.what(), false});
      out.push_back(std::move(limit));
    }
  }
  return out;
}

Malformed wrong_cell(const std::string& prefix)
{
  return Malformed(
      prefix +
      "/scene/cell_vectors: two for in_plane_periodic, three for volumetric_periodic, one for strip_roll, none for "
      "a patch");
}

/// The scene at `prefix`, as the setting has its surfaces.
Scene read_placed_scene(const json::value& scene_json, const std::string& prefix, const Setting& setting,
                        const ShapeSource& source)
{
  Scene scene = read_scene(scene_json, prefix + "/scene", source);
  for (Element& element : scene.elements)
    for (verification::Primitive& torus : element.tori) {
      torus.facets = setting.facets;
      if (torus.surface && setting.facets == 0)
        throw Malformed(prefix +
                        "/experiment/solver/contact: mesh expected, as the scene has triangle meshes");
    }
  if (scene.cell.size() != cell_dimension(setting.load)) throw wrong_cell(prefix);
  return scene;
}

/// The line about a scene, to which is added whether limits are those asked for.
VerifyLine scene_and_asked(const SceneCheck& check, const std::vector<Limit>& limits, const Work& work)
{
  VerifyLine line = check_scene(check, work.tolerances, work.record);
  Sentences problems;
  check_asked(*check.experiment, check.experiment_where, limits, problems, work.record);
  if (problems.empty()) {
    line.text += fmt::format("; {} limits as asked for", limits.size());
    return line;
  }
  return {false, (line.ok ? check.where : line.text) + fmt::format("; {}", fmt::join(problems, "; "))};
}

/// Scenes can be compared with the experiment whatever their load case is; what depends on it is left out.
void check_unknown_load(const json::value& results, const std::string& prefix, const std::string& why,
                        const Work& work)
{
  for (const char* part : {"/limits", "/profiles", "/boundary", "/design"})
    work.record.skip(prefix + part, why);
  for (const char* part : {"/experiment/load_case", "/experiment/solver", "/experiment/design"})
    work.record.skip(prefix + part, why);
  const json::value& asked =
      member(member(results, "experiment", prefix), "load_case", prefix + "/experiment");
  std::size_t i = 0;
  for (const json::value& limit : array(member(results, "limits", prefix), prefix + "/limits")) {
    const std::string where = fmt::format("{}/limits/{}", prefix, i++);
    if (member(limit, "load_case", where) == member(asked, "plugin", prefix + "/experiment/load_case"))
      work.lines.push_back({true, where + ": " + why, false});
    else
      work.malformed(where + "/load_case: not the experiment's");
  }
  const json::value& experiment = member(results, "experiment", prefix);
  const Scene scene = read_scene(member(results, "scene", prefix), prefix + "/scene",
                                 {experiment, prefix + "/experiment", work.shapes});
  SceneCheck check{&experiment,
                   prefix + "/experiment",
                   &member(results, "scene", prefix),
                   prefix + "/scene",
                   &scene,
                   {},
                   {},
                   false,
                   false,
                   &work.shapes};
  const json::value* design = results.as_object().if_contains("design");
  if (design != nullptr && !design->is_null()) return;
  check_length(scene, scene.length, prefix + "/scene");
  work.lines.push_back(check_scene(check, work.tolerances, work.record));
}

/// Does the check of a document; nothing is checked where the surfaces of its scene are not known.
template <class F>
void unless_unknown(const std::string& prefix, const Work& work, const F& check)
{
  try {
    check();
  } catch (const Unknown& unknown) {
    for (const char* part : {"/scene", "/limits", "/profiles", "/boundary", "/design", "/experiment"})
      work.record.skip(prefix + part, unknown.what());
    work.lines.push_back({true, fmt::format("{}/scene: {}", prefix, unknown.what()), false});
  }
}

/// One document's limits, profiles and scene under a known load case. Throws Unknown where the surfaces of
/// solids cannot be asked for.
void check_placed_scene(const json::value& results, const std::string& prefix, const Setting& setting,
                        const Work& work)
{
  const json::value& experiment = member(results, "experiment", prefix);
  const Scene scene = read_placed_scene(member(results, "scene", prefix), prefix, setting,
                                        {experiment, setting.where, work.shapes});
  check_length(scene, scene.length, prefix + "/scene");
  const auto limits =
      check_limits(scene, member(results, "limits", prefix), prefix, setting, experiment, work);
  const auto add = [&](VerifyLine line) {
    if (!prefix.empty()) line.text = prefix + ": " + line.text;
    work.lines.push_back(std::move(line));
  };
  if (const json::value* design = results.as_object().if_contains("design");
      design != nullptr && !design->is_null())
    throw Malformed(prefix + "/design: null expected, as nothing is designed here");
  VerifyLine profiles = check_profiles(results, setting.load, limits, work.tolerances);
  work.record.done(VerifyPart::profiles, prefix + "/profiles", profiles.ok);
  add(std::move(profiles));
  if (const json::value* boundary = results.as_object().if_contains("boundary")) {
    const bool complete = limits.size() == member(results, "limits", prefix).as_array().size();
    VerifyLine line = check_boundary(*boundary, limits, complete, work.tolerances);
    work.record.done(VerifyPart::boundary, prefix + "/boundary", line.ok);
    add(std::move(line));
  }
  const SceneCheck check{&experiment,
                         setting.where,
                         &member(results, "scene", prefix),
                         prefix + "/scene",
                         &scene,
                         setting,
                         {},
                         false,
                         false,
                         &work.shapes};
  work.lines.push_back(scene_and_asked(check, limits, work));
  work.record.done(VerifyPart::design, prefix + "/design", true);
}

/// One document's limits, profiles and scene; `prefix` is its place in the file. Throws as above.
void check_scene_and_limits(const json::value& results, const std::string& prefix, const Work& work)
{
  Setting setting;
  try {
    setting = read_setting(member(results, "experiment", prefix));
  } catch (const Unknown& unknown) {
    return check_unknown_load(results, prefix, unknown.what(), work);
  }
  setting.where = prefix + "/experiment";
  check_placed_scene(results, prefix, setting, work);
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

/// A row is done exactly when each of its limits has an answer.
void check_row_status(const std::string& status, const json::value& result, const std::string& where)
{
  bool answered = true;
  for (const json::value& limit : array(member(result, "limits", where), where + "/result/limits")) {
    const std::string of = text(member(limit, "status", where), where + "/result/limits");
    answered = answered && (of == "locked" || of == "unbounded" || of == "not_attained");
  }
  if (answered != (status == "done"))
    throw Malformed(fmt::format("{}/status: {}, but {} limits have answers", where, status,
                                answered ? "all" : "not all"));
}

/// Every row that has results, each with a scene of its own.
void check_sweep(const json::value& sweep, const Work& work)
{
  const json::array& axes = array(member(sweep, "axes", "/sweep"), "/sweep/axes");
  std::size_t k = 0;
  for (const json::value& row : array(member(sweep, "rows", "/sweep"), "/sweep/rows")) {
    const std::string where = fmt::format("/sweep/rows/{}", k++);
    const json::value& result = member(row, "result", where);
    const std::string status = text(member(row, "status", where), where);
    if (result.is_null()) {
      // Only a row that is done must have any; whether the status is one at all the table tells.
      bool nothing = status != "done";
      const json::value& measured = member(row, "measured", where);
      if (measured.is_object())
        for (const auto& [name, value] : measured.as_object()) nothing = nothing && value.is_null();
      work.record.done(VerifyPart::sweep, where, nothing);
      work.lines.push_back(
          {nothing, where + ": " + status + (nothing ? ", no results" : ", but results are missing"), false});
      continue;
    }
    try {
      for (const json::value& axis : axes) {
        const std::string name = text(member(axis, "name", "/sweep/axes"), "/sweep/axes");
        check_placed(axis, member(member(row, "values", where), name.c_str(), where),
                     member(result, "experiment", where + "/result"), where);
      }
      check_measured(member(sweep, "measures", "/sweep"), row, result, where);
      check_row_status(status, result, where);
      unless_unknown(where + "/result", work,
                     [&] { check_scene_and_limits(result, where + "/result", work); });
    } catch (const Malformed& error) {
      work.malformed(error.what());
    }
  }
}

/// The design's final and initial scene, each with limits.
void check_designed(const json::value& results, const Work& work)
{
  const json::value& experiment = member(results, "experiment", "");
  Setting setting;
  try {
    setting = read_setting(experiment);
  } catch (const Unknown& unknown) {
    return check_unknown_load(results, "", unknown.what(), work);
  }
  setting.where = "/experiment";
  const json::value& scene_json = member(results, "scene", "");
  const ShapeSource source{experiment, "/experiment", work.shapes};
  const Scene scene = read_placed_scene(scene_json, "", setting, source);
  const json::value& design = member(results, "design", "");
  const auto limits = check_limits(scene, member(results, "limits", ""), "", setting, experiment, work);
  VerifyLine profiles = check_profiles(results, setting.load, limits, work.tolerances);
  work.record.done(VerifyPart::profiles, "/profiles", profiles.ok);
  work.lines.push_back(std::move(profiles));
  const json::value& initial = member(design, "initial", "/design");
  const json::value& initial_json = member(initial, "scene", "/design/initial");
  const Scene initial_scene = read_placed_scene(initial_json, "/design/initial", setting, source);
  check_length(initial_scene, initial_scene.length, "/design/initial/scene");
  check_length(initial_scene, scene.length, "/scene");  // frozen during the design
  const auto initial_limits = check_limits(initial_scene, member(initial, "limits", "/design/initial"),
                                           "/design/initial", setting, experiment, work);
  DesignedScenes designed;
  VerifyLine line = check_design(results, initial_limits, limits, designed, work.tolerances, work.record);
  work.lines.push_back(std::move(line));
  const SceneCheck last{&experiment, "/experiment",  &scene_json, "/scene", &scene,
                        setting,     designed.final, true,        false,    &work.shapes};
  const SceneCheck first{&experiment,    "/experiment", &initial_json,    "/design/initial/scene",
                         &initial_scene, setting,       designed.initial, true,
                         true,           &work.shapes};
  work.lines.push_back(scene_and_asked(last, limits, work));
  work.lines.push_back(scene_and_asked(first, initial_limits, work));
}

void check_sweep_results(const json::value& results, const Work& work)
{
  const json::value& sweep = member(results, "sweep", "");
  VerifyLine line = check_sweep_table(member(results, "experiment", ""), sweep);
  work.record.done(VerifyPart::sweep, "/sweep", line.ok);
  work.record.done(VerifyPart::sweep, "/experiment/sweep", line.ok);
  work.lines.push_back(std::move(line));
  check_sweep(sweep, work);
}

void check_chart_results(const json::value& results, const Work& work)
{
  check_chart(member(results, "experiment", ""), member(results, "chart", ""), work.lines, work.record);
}

void check_stability_results(const json::value& results, const Work& work)
{
  check_stability(member(results, "experiment", ""), member(results, "stability", ""), work.lines,
                  work.record);
}

void check_design_results(const json::value& results, const Work& work)
{
  if (member(results, "design", "").is_null()) throw Malformed("/design: null, a design expected");
  unless_unknown("", work, [&] { check_designed(results, work); });
}

void check_limits_results(const json::value& results, const Work& work)
{
  if (!member(results, "design", "").is_null())
    throw Malformed("/experiment/task: design expected, as there is one");
  unless_unknown("", work, [&] { check_scene_and_limits(results, "", work); });
}

/// How the results of each task are checked.
using TaskCheck = void (*)(const json::value& results, const Work& work);
constexpr std::array<std::pair<std::string_view, TaskCheck>, 6> task_checks{{
    {"limits", check_limits_results},
    {"transition", check_limits_results},
    {"design", check_design_results},
    {"sweep", check_sweep_results},
    {"chart", check_chart_results},
    {"stability", check_stability_results},
}};

void check_document(const json::value& results, const Work& work)
{
  if (!results.is_object() || !results.as_object().contains("format"))
    throw Malformed("/format: missing; these are no results: give the results.json that `hauberk run` wrote");
  if (const std::string format = text(member(results, "format", ""), "/format"); format != known_format)
    throw Malformed(fmt::format("/format: {} expected, found {}", known_format, format));
  work.record.done(VerifyPart::format, "/format", true);
  const json::value& experiment = member(results, "experiment", "");
  const json::value* given = experiment.is_object() ? experiment.as_object().if_contains("task") : nullptr;
  const std::string task = given != nullptr ? text(*given, "/experiment/task") : "limits";
  const auto known = std::ranges::find(task_checks, task, &std::pair<std::string_view, TaskCheck>::first);
  if (known == task_checks.end())
    throw Malformed(fmt::format("/experiment/task: '{}' is no task that this check knows", task));
  known->second(results, work);
  work.record.done(VerifyPart::format, "/experiment/task", true);
}

}  // namespace

VerifyReport verify(const json::value& results, const VerifyTolerances& tolerances,
                    const VerifyShapes& shapes)
{
  VerifyReport report;
  Record record;
  const Work work{tolerances, record, report.lines, shapes};
  try {
    check_document(results, work);
  } catch (const std::exception& error) {
    work.malformed(error.what());
  }
  if (report.lines.empty()) report.lines.push_back({false, "nothing in this file could be checked"});
  for (const VerifyLine& line : report.lines) report.ok = report.ok && line.ok;
  report.fields = record.outcomes(results);
  return report;
}

}  // namespace hauberk
