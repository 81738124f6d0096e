#include "sweep_run.hpp"
#include "interrupt.hpp"
#include "text_table.hpp"
#include "variant_run.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/json_writer.hpp>
#include <hauberk/parallel.hpp>
#include <hauberk/results/json_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

namespace hauberk::command {
namespace {

void refuse(SweepRow& row, RowStatus status, const std::string& message)
{
  row.status = status;
  row.message = message;
}

void solve(const Loaded& loaded, const VariantReading& reading, const SweepTable& table, SweepRow& row)
{
  if (!reading.experiment) return refuse(row, RowStatus::refused, reading.refusal);
  const Experiment& e = *reading.experiment;
  RunResult run;
  try {
    run = run_variant(e);
  } catch (const InputError& error) {
    return refuse(row, RowStatus::refused, error.what());
  }
  for (LimitResult& limit : run.limits) limit.load_case = e.load_case_plugin;
  ResultNames names;
  names.macro.clear();
  for (const MacroInfo& macro : loaded.experiment.load_case->macros()) names.macro.push_back(macro.name);
  enter_result(table, row, run, write_json(e.resolved), names);
}

std::string cell(const boost::json::value& value)
{
  if (value.is_number()) return fmt::format("{:.6g}", value.to_number<double>());
  if (const boost::json::string* text = value.if_string()) return std::string(*text);
  std::string text = hauberk::write_json(value);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  return text;
}

std::string cell(const SweepRow& row, std::size_t measure)
{
  if (measure >= row.measured.size() || !row.measured[measure]) return "-";
  return fmt::format("{:.8g}", *row.measured[measure]);
}

}  // namespace

SweepTable empty_table(const Loaded& loaded)
{
  const ExperimentSweep& from = loaded.experiment.sweep.value();
  SweepTable table;
  for (const SweepAxis& axis : from.axes) {
    table.axes.push_back({axis.name, {}, axis.logarithmic});
    for (const SweepPlace& place : axis.places) {
      table.axes.back().places.push_back(
          {{"pointer", place.pointer}, {"factor", place.factor}, {"offset", place.offset}});
    }
  }
  for (const SweepMeasure& measure : from.measure) table.measures.push_back({measure.name, measure.pointer});
  table.rows.resize(from.row_count());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::vector<std::size_t> at = from.indices(row);
    for (std::size_t k = 0; k < at.size(); ++k)
      table.rows[row].values.push_back(to_boost_json(from.axes[k].values[at[k]]));
  }
  return table;
}

void run_sweep(const Loaded& loaded, unsigned threads, Progress& progress, SweepTable& table,
               const TableObserver& observer)
{
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    if (table.rows[k].status == RowStatus::interrupted) left.push_back(k);
  }
  std::mutex mutex;  // guards the rows of table, progress and observer
  std::size_t done = 0;
  progress.limits("sweep", 0, left.size());
  parallel_for(left.size(), threads, [&](std::size_t i) {
    if (interrupted()) return;
    const std::size_t k = left[i];
    SweepRow row;
    {
      const std::lock_guard lock(mutex);
      row = table.rows[k];
    }
    try {
      solve(loaded, loaded.sweep[k], table, row);
    } catch (const std::exception& error) {
      refuse(row, RowStatus::failed, error.what());
    }
    const std::lock_guard lock(mutex);
    table.rows[k] = std::move(row);
    progress.limits("sweep", ++done, left.size());
    observer(table);
  });
}

bool any_failed(const SweepTable& table)
{
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [](const SweepRow& row) { return row.status == RowStatus::failed; });
}

std::string sweep_summary(const SweepTable& table)
{
  std::vector<std::vector<std::string>> cells(1);
  for (const SweepTable::Axis& axis : table.axes) cells[0].push_back(axis.name);
  for (const SweepTable::Measure& measure : table.measures) cells[0].push_back(measure.name);
  cells[0].emplace_back("status");
  for (const SweepRow& row : table.rows) {
    std::vector<std::string>& line = cells.emplace_back();
    for (const boost::json::value& value : row.values) line.push_back(cell(value));
    for (std::size_t k = 0; k < table.measures.size(); ++k) line.push_back(cell(row, k));
    line.push_back(to_string(row.status));
  }
  std::string text = text_table(cells);
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const SweepRow& row = table.rows[k];
    if (row.status == RowStatus::failed || row.status == RowStatus::refused)
      text += fmt::format("row {}, {}: {}\n", k, to_string(row.status), row.message);
  }
  return text;
}

}  // namespace hauberk::command
