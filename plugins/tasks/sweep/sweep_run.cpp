#include "tasks/sweep/sweep_run.hpp"

#include "document/json_text.hpp"
#include "document/json_writer.hpp"
#include "run/interrupt.hpp"
#include "run/text_table.hpp"
#include "run/variant_run.hpp"
#include "tasks/sweep/row_lessons.hpp"
#include "tasks/sweep/sweep_task.hpp"
#include "tasks/variants/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace hauberk {
namespace {

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

std::vector<std::size_t> all_rows(std::size_t count)
{
  std::vector<std::size_t> out(count);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// The scenes of all rows. Those that are none are done with that.
class SweepScenes : public GridRows {
 public:
  SweepScenes(const std::vector<VariantReading>& readings, std::vector<bool> left, SweepTable& table)
      : scenes(readings.size()), readings_(readings), left_(std::move(left)), table_(table)
  {
  }

  const VariantReading& variant(std::size_t row) const override { return readings_[row]; }

  EnterRow solve(std::size_t row, const Experiment& e) override
  {
    scenes[row] = prepare_variant(e);
    return {};
  }

  EnterRow refuse(std::size_t row, RowStatus status, const std::string& message) override
  {
    SweepRow out = table_.rows[row];
    out.status = status;
    out.message = message;
    return enter(row, std::move(out));
  }

  /// Rows that others begin from are solved again and entered once.
  EnterRow enter(std::size_t row, SweepRow result)
  {
    if (!left_[row]) return {};
    return [this, row, result = std::move(result)]() -> std::size_t {
      table_.rows[row] = result;
      return 1;
    };
  }

  const SweepTable& table() const { return table_; }

  std::vector<RowScene> scenes;

 private:
  const std::vector<VariantReading>& readings_;
  std::vector<bool> left_;
  SweepTable& table_;
};

/// The limits of rows that have scenes, each from its own start and from the states of its donors.
class SweepLimits final : public GridRows {
 public:
  SweepLimits(SweepScenes& rows, const std::vector<std::vector<std::size_t>>& donors,
              std::vector<std::string> macro_names, const RunContext& context)
      : rows_(rows),
        donors_(donors),
        macro_names_(std::move(macro_names)),
        context_(context),
        states_(rows.scenes.size())
  {
  }

  const VariantReading& variant(std::size_t row) const override { return rows_.variant(row); }

  EnterRow solve(std::size_t row, const Experiment& e) override
  {
    PreparedVariant variant = *rows_.scenes[row];
    for (const std::size_t donor : donors_[row]) {
      std::vector<GivenState> given =
          given_by(*rows_.scenes[donor], states_[donor], *rows_.scenes[row], donor);
      std::move(given.begin(), given.end(), std::back_inserter(variant.settings.given));
    }
    RowMemory memory(context_, row);
    VariantLimits solved = solve_variant(variant, 1, memory.get());
    states_[row] = solved.states;
    RunResult run = variant_result(e, std::move(variant), std::move(solved));
    for (LimitResult& limit : run.limits) limit.load_case = e.load_case_plugin;
    SweepRow out = rows_.table().rows[row];
    enter_result(rows_.table(), out, run, write_json(e.resolved), macro_names_);
    if (out.status == RowStatus::interrupted) return {};
    return rows_.enter(row, std::move(out));
  }

  EnterRow refuse(std::size_t row, RowStatus status, const std::string& message) override
  {
    return rows_.refuse(row, status, message);
  }

 private:
  SweepScenes& rows_;
  const std::vector<std::vector<std::size_t>>& donors_;
  std::vector<std::string> macro_names_;
  const RunContext& context_;
  std::vector<std::vector<std::optional<State>>> states_;  ///< furthest locked, by row and task
};

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

/// Rows without results and why, as many and as much of each as one reads.
std::string remarks(const SweepTable& table)
{
  constexpr std::size_t most_rows = 50, most_characters = 300;
  std::string text;
  std::size_t without = 0;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const SweepRow& row = table.rows[k];
    if ((row.status != RowStatus::failed && row.status != RowStatus::refused) || ++without > most_rows)
      continue;
    std::size_t end = std::min(row.message.size(), most_characters);
    while (end < row.message.size() && (static_cast<unsigned char>(row.message[end]) & 0xc0U) == 0x80U) --end;
    text += fmt::format("row {}, {}: {}{}\n", k, to_string(row.status), row.message.substr(0, end),
                        end < row.message.size() ? " ..." : "");
  }
  if (without > most_rows)
    text += fmt::format("{} more rows without results, {} in all; what is wrong with each is in {}\n",
                        without - most_rows, without, sweep_file_names.front());
  return text;
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

void run_sweep(const LoadCase& load_case, const std::vector<VariantReading>& readings, RunContext& context,
               SweepTable& table)
{
  const std::size_t n = table.rows.size();
  std::vector<bool> left(n);
  for (std::size_t k = 0; k < n; ++k) left[k] = table.rows[k].status == RowStatus::interrupted;
  const std::size_t rows_left = std::count(left.begin(), left.end(), true);
  if (rows_left == 0) return;
  Grid grid(context, "sweep", rows_left);

  // Scenes first: they say which row learns from which. A row that is done already and teaches is solved
  // again.
  SweepScenes scenes(readings, left, table);
  grid.run(scenes, all_rows(n), context.threads);
  if (interrupted()) return;
  const std::vector<std::vector<std::size_t>> donors = row_donors(scenes.scenes), rounds = row_rounds(donors);
  const std::vector<bool> needed = needed_rows(left, donors, rounds);
  SweepLimits limits(scenes, donors, macro_names(load_case), context);
  for (const std::vector<std::size_t>& round : rounds) {
    std::vector<std::size_t> order;
    std::copy_if(round.begin(), round.end(), std::back_inserter(order),
                 [&](std::size_t k) { return needed[k] && scenes.scenes[k]; });
    grid.run(limits, order, context.threads);
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
  return text_table(cells) + remarks(table);
}

}  // namespace hauberk
