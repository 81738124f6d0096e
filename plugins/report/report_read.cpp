#include "document/json_place.hpp"
#include "report/report.hpp"
#include "results/aim_json.hpp"
#include "results/document.hpp"

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::JsonPlace;

/// Refuses what is no result, or none that a report has room for; returns its task.
std::string check_kind(const JsonPlace& document)
{
  constexpr const char* way_out = "give the results.json that `hauberk run` wrote, or its folder";
  if (!document.value().is_object() || !document.find("format"))
    document.fail(std::string("these are no results; ") + way_out);
  const JsonPlace format = document.at("format");
  if (format.text() != results_format)
    format.fail(std::string("expected ") + results_format + ", found " + format.text() + "; " + way_out);
  std::string task = document.at("experiment").at("task").text();
  if (task != "design" && task != "limits")
    document.fail("a report shows designs and limits, and these are results of task " + task +
                  "; leave them out: their folder has a table and a picture of their own");
  return task;
}

std::vector<LimitResult> read_limits(const JsonPlace& list)
{
  std::vector<LimitResult> out;
  for (const JsonPlace& item : list.items()) {
    LimitResult limit;
    if (item.find("direction"))
      item.fail(
          "this limit is along a direction of the macroscopic unknowns, and a report shows angles; leave the "
          "file out: its folder has a picture of its own, boundary.svg");
    limit.direction = Direction::at_degrees(item.at("direction_deg").number());
    limit.sense = item.at("sense").text();
    const std::optional<LimitStatus> status = limit_status(item.at("status").text());
    if (!status) item.at("status").fail("'" + item.at("status").text() + "' is no status of a limit");
    limit.status = *status;
    limit.value = item.optional_number("value");
    limit.better_state = item.at("better_state").boolean();
    out.push_back(std::move(limit));
  }
  return out;
}

std::vector<ProfilePoint> read_profiles(const JsonPlace& list)
{
  std::vector<ProfilePoint> out;
  for (const JsonPlace& item : list.items())
    out.push_back({item.at("direction_deg").number(), item.optional_number("e_s"),
                   item.optional_number("e_c"), item.optional_number("eta")});
  return out;
}

/// True for directions that are the same modulo 180 degrees.
bool same_direction(double a, double b) { return std::abs(std::remainder(a - b, 180.0)) < 1e-9; }

/// The published value of the target in that direction.
std::optional<double> published_value(const JsonPlace& design, double direction)
{
  for (const JsonPlace& target : design.at("targets").items()) {
    if (same_direction(target.at("direction_deg").number(), direction))
      return target.optional_number("published");
  }
  return std::nullopt;
}

/// The rows of a table, each of `columns` numbers; none where there is no table.
std::vector<std::vector<double>> rows_of(const JsonPlace& parent, const char* key, std::size_t columns)
{
  std::vector<std::vector<double>> out;
  const std::optional<JsonPlace> table = parent.find(key);
  if (!table) return out;
  for (const JsonPlace& row : table->items()) {
    std::vector<double>& numbers = out.emplace_back();
    for (const JsonPlace& number : row.items()) numbers.push_back(number.number());
    if (numbers.size() != columns) row.fail(fmt::format("expected {} numbers", columns));
  }
  return out;
}

std::optional<PublishedDesign> read_published(const JsonPlace& design)
{
  const std::optional<JsonPlace> published = design.find("published");
  if (!published) return std::nullopt;
  PublishedDesign out{published->at("source").text(),
                      published->optional_number("lowest"),
                      published->optional_number("highest"),
                      published->optional_number("iterations"),
                      published->optional_number("seconds_per_iteration"),
                      {},
                      {}};
  for (const std::vector<double>& row : rows_of(*published, "profile", 2))
    out.profile.emplace_back(row[0], row[1]);
  for (const std::vector<double>& row : rows_of(*published, "measured", 3))
    out.measured.push_back({row[0], row[1], row[2]});
  return out;
}

ReportDesign read_design(const JsonPlace& design, const JsonPlace& asked)
{
  ReportDesign out;
  out.quantity = design.at("quantity").text();
  out.status = design.at("status").text();
  out.iterations = design.at("iterations").integer();
  out.evaluations = design.at("evaluations").integer();
  out.seconds = design.optional_number("seconds");
  const std::vector<JsonPlace> history = design.at("history").items();
  const std::optional<double> searched =
      history.empty() ? std::nullopt : history.back().optional_number("seconds");
  if (searched && out.iterations > 0)
    out.seconds_per_iteration = *searched / static_cast<double>(out.iterations);
  out.published = read_published(asked);
  for (const JsonPlace& item : design.at("targets").items()) {
    ReportTarget target;
    target.direction_deg = item.at("direction_deg").number();
    target.target = item.at("target").number();
    target.aim = read_aim(item);
    target.published = published_value(asked, target.direction_deg);
    target.initial = item.optional_number("initial");
    target.provisional = item.optional_number("provisional");
    target.recomputed = item.optional_number("recomputed");
    target.better_state = item.at("better_state").boolean();
    target.met = item.at("met").boolean();
    out.targets.push_back(target);
  }
  return out;
}

/// What a plot needs of a design.
DesignResult plotted(const ReportDesign& design, const JsonPlace& initial)
{
  DesignResult out;
  out.quantity = design.quantity;
  for (const ReportTarget& target : design.targets) {
    out.targets.emplace_back();
    out.targets.back().direction_deg = target.direction_deg;
    out.targets.back().target = target.target;
    out.targets.back().aim = target.aim;
  }
  out.initial_limits = read_limits(initial.at("limits"));
  return out;
}

json::value scene_of(const JsonPlace& document)
{
  json::array parameters;
  for (const JsonPlace& element : document.at("scene").at("elements").items())
    parameters.push_back(element.at("parameters").value());
  const JsonPlace asked = document.at("experiment").at("load_case");
  (void)asked.at("plugin").text();
  json::object load = asked.value().as_object();
  for (const char* what : {"directions_deg", "senses"}) load.erase(what);
  return json::object{{"parameters", std::move(parameters)},
                      {"load_case", std::move(load)},
                      {"clearance", document.at("experiment").at("solver").at("clearance").value()}};
}

void name_senses(ReportEntry& entry)
{
  const auto bends = [](const LimitResult& limit) { return limit.sense == "up" || limit.sense == "down"; };
  const bool bending = std::any_of(entry.run.limits.begin(), entry.run.limits.end(), bends) ||
                       (entry.design && entry.design->quantity == "curvature");
  entry.positive = bending ? "up" : "stretch";
  entry.negative = bending ? "down" : "compress";
  entry.unit = bending ? "1/" + entry.length_unit : "strain";
}

std::optional<double> value_of(const ProfilePoint& point, const std::string& quantity, double target)
{
  if (quantity == "eta") return point.eta;
  if (quantity == "stretch" || (quantity == "curvature" && target >= 0.0)) return point.e_s;
  return point.e_c;
}

}  // namespace

ReportEntry read_report_entry(const json::value& document, const std::string& file)
{
  const JsonPlace top(document, file);
  const std::string task = check_kind(top);
  ReportEntry out;
  out.file = file;
  out.name = top.at("experiment").at("name").text();
  out.length_unit = top.at("experiment").at("length_unit").text();
  out.threads = top.at("provenance").optional_number("threads");
  out.peak_memory = top.at("provenance").optional_number("peak_memory_bytes");
  out.run.limits = read_limits(top.at("limits"));
  out.run.profiles = read_profiles(top.at("profiles"));
  if (task == "design") {
    const JsonPlace design = top.at("design");
    out.design = read_design(design, top.at("experiment").at("design"));
    out.run.design = plotted(*out.design, design.at("initial"));
  }
  out.scene = scene_of(top);
  name_senses(out);
  return out;
}

void enter_recheck(ReportEntry& entry, const json::value& document, const std::string& file)
{
  const ReportEntry recheck = read_report_entry(document, file);
  const JsonPlace top(document, file);
  if (!entry.design) top.fail(entry.file + " is no design: there is nothing to recheck");
  if (recheck.design || recheck.scene != entry.scene)
    top.fail("these are no limits of the scene that " + entry.file +
             " designed; run the designed.json beside it anew, with the same load case and clearance");
  entry.design->rechecked = true;
  for (ReportTarget& target : entry.design->targets) {
    for (const ProfilePoint& point : recheck.run.profiles) {
      if (same_direction(point.direction_deg, target.direction_deg))
        target.rechecked = value_of(point, entry.design->quantity, target.target);
    }
  }
}

}  // namespace hauberk
