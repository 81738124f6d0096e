#include "document/json_values.hpp"
#include "results/csv_cells.hpp"
#include "results/direction_json.hpp"
#include "results/json_parts.hpp"
#include "tasks/chart/chart_results.hpp"

#include <boost/json/array.hpp>

#include <algorithm>

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::number;
using Values = std::vector<std::optional<double>>;

json::array numbers_json(const Values& values)
{
  json::array out;
  for (const std::optional<double>& x : values) out.push_back(number(x));
  return out;
}

Values read_numbers(const json::value& list)
{
  Values out;
  for (const json::value& x : list.as_array()) out.push_back(number_or_none(x));
  return out;
}

std::string text(const json::value& v) { return std::string(v.as_string()); }

/// What a run gave, apart from how long it took.
void enter_outcome(json::object& out, const PrecisionRun& run)
{
  out["values"] = numbers_json(run.values);
  out["error_estimates"] = numbers_json(run.estimates);
  out["locked"] = run.locked;
  out["iterations"] = run.iterations;
  out["evaluations"] = run.evaluations;
}

PrecisionRun read_outcome(const json::value& entry)
{
  PrecisionRun run;
  run.values = read_numbers(entry.at("values"));
  run.estimates = read_numbers(entry.at("error_estimates"));
  run.locked = entry.at("locked").to_number<int>();
  run.iterations = entry.at("iterations").to_number<std::int64_t>();
  run.evaluations = entry.at("evaluations").to_number<std::int64_t>();
  return run;
}

json::value reference_json(const PrecisionScene& scene)
{
  if (!scene.has_reference) return nullptr;
  const PrecisionRun run = scene.reference.value_or(PrecisionRun{});
  json::object out{{"status", to_string(run.status)}, {"message", run.message}};
  enter_outcome(out, run);
  out["seconds"] = number(run.seconds);
  return out;
}

json::object scene_json(const PrecisionScene& scene)
{
  json::object out{{"name", scene.name}};
  json::array& limits = out["limits"].emplace_array();
  for (const PrecisionScene::Limit& limit : scene.limits) {
    json::object entry;
    enter_direction(entry, limit.direction);
    entry["sense"] = limit.sense;
    limits.push_back(std::move(entry));
  }
  out["exact"] = scene.exact.empty() ? json::value(nullptr) : json::value(numbers_json(scene.exact));
  out["reference"] = reference_json(scene);
  out["floor"] = number(scene.floor());
  return out;
}

json::value seconds_json(const PrecisionPoint& point)
{
  if (point.seconds.empty()) return nullptr;
  const auto [least, most] = std::minmax_element(point.seconds.begin(), point.seconds.end());
  return json::object{{"median", number(point.median_seconds())},
                      {"min", number(*least)},
                      {"max", number(*most)},
                      {"runs", json::array(point.seconds.begin(), point.seconds.end())}};
}

json::object point_json(const PrecisionChart& chart, const PrecisionPoint& point)
{
  const PrecisionMethod& method = chart.methods[point.method];
  json::object out{{"scene", chart.scenes[point.scene].name},
                   {"method", method.name},
                   {"setting", method.settings[point.setting]},
                   {"threads", point.threads},
                   {"status", to_string(point.status)},
                   {"message", point.message},
                   {"error", number(point.error)}};
  enter_outcome(out, point.first.value_or(PrecisionRun{}));
  out["seconds"] = seconds_json(point);
  out["peak_memory_bytes"] =
      point.peak_memory_bytes ? json::value(*point.peak_memory_bytes) : json::value(nullptr);
  out["pareto"] = point.pareto;
  out["pareto_work"] = point.pareto_work;
  out["reproducible"] = point.reproducible;
  return out;
}

bool take_scene(const json::value& entry, PrecisionScene& scene)
{
  if (text(entry.at("name")) != scene.name) return false;
  const json::value& reference = entry.at("reference");
  if (!scene.has_reference || text(reference.at("status")) == to_string(RowStatus::interrupted)) return true;
  PrecisionRun run = read_outcome(reference);
  run.status = row_status(text(reference.at("status"))).value_or(RowStatus::failed);
  run.message = text(reference.at("message"));
  if (!reference.at("seconds").is_null()) run.seconds = reference.at("seconds").to_number<double>();
  if (!entry.at("exact").is_null()) scene.exact = read_numbers(entry.at("exact"));
  scene.reference = std::move(run);
  return true;
}

bool take_point(const json::value& entry, const PrecisionChart& chart, PrecisionPoint& point)
{
  const PrecisionMethod& method = chart.methods[point.method];
  if (text(entry.at("scene")) != chart.scenes[point.scene].name || text(entry.at("method")) != method.name ||
      text(entry.at("setting")) != method.settings[point.setting] ||
      entry.at("threads").to_number<int>() != point.threads)
    return false;
  point.status = row_status(text(entry.at("status"))).value_or(point.status);
  point.message = text(entry.at("message"));
  point.reproducible = entry.at("reproducible").as_bool();
  if (!entry.at("peak_memory_bytes").is_null())
    point.peak_memory_bytes = entry.at("peak_memory_bytes").to_number<std::int64_t>();
  if (entry.at("seconds").is_null()) return true;
  point.seconds.clear();
  for (const json::value& x : entry.at("seconds").at("runs").as_array())
    point.seconds.push_back(x.to_number<double>());
  point.first = read_outcome(entry);
  point.first->status = point.status == RowStatus::interrupted ? RowStatus::done : point.status;
  return true;
}

}  // namespace

json::object chart_json(const PrecisionChart& chart)
{
  json::object out{{"repeats", chart.repeats},
                   {"threads", json::array(chart.threads.begin(), chart.threads.end())}};
  json::object& counts = out["counts"].emplace_object();
  for (const RowStatus status : row_statuses) {
    counts[to_string(status)] =
        std::count_if(chart.points.begin(), chart.points.end(),
                      [status](const PrecisionPoint& point) { return point.status == status; });
  }
  json::array& scenes = out["scenes"].emplace_array();
  for (const PrecisionScene& scene : chart.scenes) scenes.push_back(scene_json(scene));
  json::array& methods = out["methods"].emplace_array();
  for (const PrecisionMethod& method : chart.methods) {
    json::array settings;
    for (const std::string& setting : method.settings) settings.emplace_back(setting);
    methods.push_back({{"name", method.name}, {"settings", std::move(settings)}});
  }
  json::array& points = out["points"].emplace_array();
  for (const PrecisionPoint& point : chart.points) points.push_back(point_json(chart, point));
  return out;
}

bool take_chart(const json::value& recorded, PrecisionChart& chart)
{
  const json::array& scenes = recorded.at("scenes").as_array();
  const json::array& points = recorded.at("points").as_array();
  if (scenes.size() != chart.scenes.size() || points.size() != chart.points.size()) return false;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    if (!take_scene(scenes[k], chart.scenes[k])) return false;
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!take_point(points[k], chart, chart.points[k])) return false;
  }
  evaluate(chart);
  return true;
}

std::string chart_csv(const PrecisionChart& chart)
{
  using detail::number_cell;
  using detail::text_cell;
  std::string out = detail::csv_line({"scene", "method", "setting", "threads", "status", "error",
                                      "seconds_median", "seconds_min", "seconds_max", "runs", "evaluations",
                                      "iterations", "peak_memory_bytes", "locked", "limits", "pareto",
                                      "pareto_work", "reproducible", "message"});
  const auto word = [](bool b) { return std::string(b ? "true" : "false"); };
  for (const PrecisionPoint& p : chart.points) {
    const PrecisionMethod& method = chart.methods[p.method];
    const PrecisionRun run = p.first.value_or(PrecisionRun{});
    const auto [least, most] = std::minmax_element(p.seconds.begin(), p.seconds.end());
    out += detail::csv_line(
        {text_cell(chart.scenes[p.scene].name), text_cell(method.name), text_cell(method.settings[p.setting]),
         std::to_string(p.threads), to_string(p.status), number_cell(p.error),
         number_cell(p.median_seconds()), p.seconds.empty() ? "" : number_cell(*least),
         p.seconds.empty() ? "" : number_cell(*most), std::to_string(p.seconds.size()),
         std::to_string(run.evaluations), std::to_string(run.iterations),
         p.peak_memory_bytes ? std::to_string(*p.peak_memory_bytes) : "", std::to_string(run.locked),
         std::to_string(chart.scenes[p.scene].limits.size()), word(p.pareto), word(p.pareto_work),
         word(p.reproducible), text_cell(p.message)});
  }
  return out;
}

}  // namespace hauberk
