#include <hauberk/verify/verify.hpp>

#include "checks.hpp"
#include "read.hpp"

#include <fmt/format.h>
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
      limit.label = fmt::format("{} ({:g} deg, {})", where, limit.direction_deg, limit.sense);
      lines.push_back(check_limit(scene, setting, limit, tolerances));
      out.push_back(std::move(limit));
    } catch (const Malformed& error) {
      lines.push_back({false, error.what()});
    }
  }
  return out;
}

void check_document(const json::value& results, const VerifyTolerances& tolerances,
                    std::vector<VerifyLine>& lines)
{
  if (!results.is_object() || !results.as_object().contains("format"))
    throw Malformed("/format: missing; these are no results: give the results.json that `hauberk run` wrote");
  if (const std::string format = text(member(results, "format", ""), "/format"); format != known_format)
    throw Malformed(fmt::format("/format: {} expected, found {}", known_format, format));
  const Setting setting = read_setting(member(results, "experiment", ""));
  const Scene scene = read_scene(member(results, "scene", ""), "/scene");
  if ((setting.load == Load::strain) != (scene.cell.size() == 2))
    throw Malformed("/scene/cell_vectors: two for in_plane_periodic, none for a patch");
  const json::value& design = member(results, "design", "");
  if (design.is_null()) check_length(scene, scene.length, "/scene");
  const auto limits = check_limits(scene, member(results, "limits", ""), "", setting, tolerances, lines);
  lines.push_back(check_profiles(results, setting.load, limits, tolerances));
  if (design.is_null()) return;

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
  for (const VerifyLine& line : report.lines) report.ok = report.ok && line.ok;
  return report;
}

}  // namespace hauberk
