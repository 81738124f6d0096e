#include "tasks/sweep/sweep_run.hpp"
#include "run/interrupt.hpp"
#include "run/text_table.hpp"
#include "run/variant_run.hpp"
#include "tasks/sweep/row_lessons.hpp"

#include <hauberk/error.hpp>
#include <hauberk/parallel.hpp>
#include "document/json_text.hpp"
#include "document/json_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <mutex>

namespace hauberk {
namespace {

void refuse(SweepRow& row, RowStatus status, const std::string& message)
{
  row.status = status;
  row.message = message;
}

/// A row's scene; where there is none, the row says why.
RowScene scene_of(const VariantReading& reading, SweepRow& row)
{
  try {
    if (reading.experiment) return prepare_variant(*reading.experiment);
    refuse(row, RowStatus::refused, reading.refusal);
  } catch (const InputError& error) {
    refuse(row, RowStatus::refused, error.what());
  } catch (const std::exception& error) {
    refuse(row, RowStatus::failed, error.what());
  }
  return std::nullopt;
}

/// Rows that are to be computed: those that are left, and all whose states they begin from.
std::vector<bool> needed_rows(const std::vector<bool>& left,
                              const std::vector<std::vector<std::size_t>>& donors,
                              const std::vector<std::vector<std::size_t>>& rounds)
{
  std::vector<bool> needed = left;
  for (auto round = rounds.rbegin(); round != rounds.rend(); ++round) {
    for (const std::size_t k : *round) {
      if (!needed[k]) continue;
      for (const std::size_t donor : donors[k]) needed[donor] = true;
    }
  }
  return needed;
}

std::string cell(const boost::json::value& value)
{
  if (value.is_number()) return fmt::format("{:.6g}", value.to_number<double>());
  if (const boost::json::string* text = value.if_string()) return std::string(*text);
  std::string text = write_json(value);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  return text;
}

std::string cell(const SweepRow& row, std::size_t measure)
{
  if (measure >= row.measured.size() || !row.measured[measure]) return "-";
  return fmt::format("{:.8g}", *row.measured[measure]);
}

}  // namespace

SweepTable empty_table(const ExperimentSweep& from)
{
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

void run_sweep(const LoadCase& load_case, const std::vector<VariantReading>& readings, unsigned threads,
               Progress& progress, SweepTable& table, const TableObserver& observer)
{
  const std::size_t n = table.rows.size();
  std::vector<bool> left(n);
  for (std::size_t k = 0; k < n; ++k) left[k] = table.rows[k].status == RowStatus::interrupted;
  const auto rows_left = static_cast<std::size_t>(std::count(left.begin(), left.end(), true));
  progress.limits("sweep", 0, rows_left);
  if (rows_left == 0) return;

  // Scenes first: they say which row learns from which. A row that is done already and teaches is solved
  // again.
  std::vector<SweepRow> rows = table.rows;
  std::vector<RowScene> scenes(n);
  parallel_for(n, threads, [&](std::size_t k) {
    if (!interrupted()) scenes[k] = scene_of(readings[k], rows[k]);
  });
  if (interrupted()) return;
  const std::vector<std::vector<std::size_t>> donors = row_donors(scenes), rounds = row_rounds(donors);
  const std::vector<bool> needed = needed_rows(left, donors, rounds);

  const std::vector<std::string> names = macro_names(load_case);
  std::vector<std::vector<std::optional<State>>> states(n);
  std::mutex mutex;  // guards the rows of table, progress and observer
  std::size_t done = 0;
  const auto finish = [&](std::size_t k, SweepRow row) {
    if (!left[k]) return;
    const std::lock_guard lock(mutex);
    table.rows[k] = std::move(row);
    progress.limits("sweep", ++done, rows_left);
    observer(table);
  };
  for (const std::vector<std::size_t>& round : rounds) {
    parallel_for(round.size(), threads, [&](std::size_t i) {
      const std::size_t k = round[i];
      if (interrupted() || !needed[k]) return;
      SweepRow row = std::move(rows[k]);
      if (!scenes[k]) return finish(k, std::move(row));
      const Experiment& e = *readings[k].experiment;
      try {
        PreparedVariant variant = *scenes[k];
        for (const std::size_t donor : donors[k]) {
          std::vector<GivenState> given = given_by(*scenes[donor], states[donor], *scenes[k], donor);
          std::move(given.begin(), given.end(), std::back_inserter(variant.settings.given));
        }
        VariantLimits solved = solve_variant(variant, 1);
        states[k] = solved.states;
        RunResult run = variant_result(e, std::move(variant), std::move(solved));
        for (LimitResult& limit : run.limits) limit.load_case = e.load_case_plugin;
        enter_result(table, row, run, write_json(e.resolved), names);
      } catch (const InputError& error) {
        refuse(row, RowStatus::refused, error.what());
      } catch (const std::exception& error) {
        refuse(row, RowStatus::failed, error.what());
      }
      finish(k, std::move(row));
    });
  }
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

}  // namespace hauberk
