#include "tasks/sweep/sweep_results.hpp"

#include "document/json_text.hpp"
#include "results/csv_cells.hpp"
#include "results/json_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::number;

/// A number at a place of the row's document; nothing where there is none.
std::optional<double> measured_at(const json::value& document, const std::string& pointer)
{
  json::error_code error;
  const json::value* v = document.find_pointer(pointer, error);
  if (v == nullptr || !v->is_number()) return std::nullopt;
  return v->to_number<double>();
}

std::int64_t evaluations(const SweepRow& row)
{
  std::int64_t sum = 0;
  if (const json::object* result = row.result.if_object()) {
    for (const json::value& limit : result->at("limits").as_array())
      sum += limit.at("evaluations").to_number<std::int64_t>();
  }
  return sum;
}

std::string value_cell(const json::value& value)
{
  if (value.is_number()) return detail::number_cell(value.to_number<double>());
  if (const json::string* text = value.if_string()) return detail::text_cell(std::string(*text));
  std::string text = write_json(value);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  return detail::text_cell(text);
}

json::object row_json(const SweepTable& table, const SweepRow& row)
{
  json::object out;
  json::object& values = out["values"].emplace_object();
  for (std::size_t k = 0; k < row.values.size(); ++k) values[table.axes[k].name] = row.values[k];
  out["status"] = to_string(row.status);
  out["message"] = row.message;
  json::object& measured = out["measured"].emplace_object();
  for (std::size_t k = 0; k < table.measures.size(); ++k)
    measured[table.measures[k].name] = k < row.measured.size() ? number(row.measured[k]) : nullptr;
  out["result"] = row.result;
  return out;
}

}  // namespace

void enter_result(const SweepTable& table, SweepRow& row, const RunResult& run,
                  const std::string& experiment_json, const std::vector<std::string>& macro_names)
{
  json::object document = results_document(run, experiment_json, macro_names);
  for (const char* key : {"provenance", "plan", "files"}) document.erase(key);
  std::tie(row.status, row.message) = status_of(run.limits);
  if (row.status == RowStatus::interrupted) return;
  row.result = std::move(document);
  row.measured.clear();
  for (const SweepTable::Measure& measure : table.measures)
    row.measured.push_back(measured_at(row.result, measure.pointer));
}

json::object sweep_json(const SweepTable& table)
{
  json::object out;
  json::array& axes = out["axes"].emplace_array();
  for (const SweepTable::Axis& axis : table.axes)
    axes.push_back({{"name", axis.name}, {"places", axis.places}});
  json::array& measures = out["measures"].emplace_array();
  for (const SweepTable::Measure& m : table.measures)
    measures.push_back({{"name", m.name}, {"pointer", m.pointer}});
  json::object& counts = out["counts"].emplace_object();
  for (const RowStatus status : row_statuses) {
    counts[to_string(status)] = std::count_if(table.rows.begin(), table.rows.end(),
                                              [status](const SweepRow& row) { return row.status == status; });
  }
  json::array& rows = out["rows"].emplace_array();
  for (const SweepRow& row : table.rows) rows.push_back(row_json(table, row));
  return out;
}

bool take_row(const json::value& entry, const SweepTable& table, SweepRow& row)
{
  for (std::size_t k = 0; k < row.values.size(); ++k) {
    if (entry.at("values").at(table.axes[k].name) != row.values[k]) return false;
  }
  row.status = row_status(std::string(entry.at("status").as_string())).value_or(row.status);
  if (row.status == RowStatus::interrupted) return true;
  row.message = std::string(entry.at("message").as_string());
  row.result = entry.at("result");
  row.measured.clear();
  for (const SweepTable::Measure& measure : table.measures) {
    const json::value& v = entry.at("measured").at(measure.name);
    row.measured.push_back(v.is_number() ? std::optional(v.to_number<double>()) : std::nullopt);
  }
  return true;
}

std::string sweep_csv(const SweepTable& table)
{
  using detail::number_cell;
  using detail::text_cell;
  std::vector<std::string> header;
  for (const SweepTable::Axis& axis : table.axes) header.push_back(text_cell(axis.name));
  header.emplace_back("status");
  for (const SweepTable::Measure& m : table.measures) header.push_back(text_cell(m.name));
  header.insert(header.end(), {"evaluations", "message"});
  std::string out = detail::csv_line(header);
  for (const SweepRow& row : table.rows) {
    std::vector<std::string> cells;
    for (const json::value& value : row.values) cells.push_back(value_cell(value));
    cells.push_back(to_string(row.status));
    for (std::size_t k = 0; k < table.measures.size(); ++k)
      cells.push_back(k < row.measured.size() ? number_cell(row.measured[k]) : "");
    cells.push_back(std::to_string(evaluations(row)));
    cells.push_back(text_cell(row.message));
    out += detail::csv_line(cells);
  }
  return out;
}

}  // namespace hauberk
