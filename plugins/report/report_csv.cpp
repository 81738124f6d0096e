#include "report/report.hpp"
#include "report/report_figures.hpp"
#include "results/csv_cells.hpp"

#include <map>
#include <utility>

namespace hauberk {
namespace {

using detail::number_cell;
using detail::text_cell;

constexpr std::array columns{
    // What the row is about.
    "row", "name", "file", "quantity", "unit", "direction_deg",
    // A direction of a design.
    "target", "aim", "published", "initial", "provisional", "recomputed", "deviation", "rechecked",
    "recheck_change", "better_state", "met",
    // A direction of limits.
    "e_s", "e_c", "eta",
    // A design; sums.
    "targets", "targets_met", "values", "rms_percent", "worst_percent", "published_values",
    "rms_there_percent", "published_rms_percent", "published_worst_percent", "rechecked_rms_percent",
    "recheck_worst_change_percent", "status", "iterations", "evaluations", "seconds", "seconds_per_iteration",
    "published_iterations", "published_seconds_per_iteration", "published_seconds", "peak_memory_bytes",
    "threads"};

/// Cells by column; those that are not named are empty.
using Row = std::map<std::string, std::string>;

std::string line(const Row& row)
{
  std::vector<std::string> cells;
  cells.reserve(columns.size());
  for (const char* column : columns) {
    const auto cell = row.find(column);
    cells.push_back(cell == row.end() ? std::string() : cell->second);
  }
  return detail::csv_line(cells);
}

const char* truth(bool x) { return x ? "true" : "false"; }

std::optional<double> difference(const std::optional<double>& a, const std::optional<double>& b)
{
  return a && b ? std::optional(*a - *b) : std::nullopt;
}

Row about(const ReportEntry& entry, const char* kind)
{
  return {{"row", kind}, {"name", text_cell(entry.name)}, {"file", text_cell(entry.file)}};
}

void add_deviations(Row& row, const ReportDesign& design)
{
  const detail::Deviation ours = detail::deviation(design, &ReportTarget::recomputed);
  const detail::Deviation there =
      detail::deviation(design, &ReportTarget::recomputed, &ReportTarget::published);
  const detail::Deviation theirs =
      detail::deviation(design, &ReportTarget::published, &ReportTarget::recomputed);
  row["values"] = std::to_string(ours.values);
  row["rms_percent"] = number_cell(ours.rms);
  row["worst_percent"] = number_cell(ours.worst);
  row["published_values"] = std::to_string(theirs.values);
  row["rms_there_percent"] = number_cell(there.rms);
  row["published_rms_percent"] = number_cell(theirs.rms);
  row["published_worst_percent"] = number_cell(detail::published_worst(design));
  row["rechecked_rms_percent"] = number_cell(detail::deviation(design, &ReportTarget::rechecked).rms);
  row["recheck_worst_change_percent"] = number_cell(detail::recheck_change(design));
}

std::string design_line(const ReportEntry& entry)
{
  const ReportDesign& design = *entry.design;
  Row row = about(entry, "design");
  row["quantity"] = text_cell(design.quantity);
  row["unit"] = text_cell(entry.unit);
  row["targets"] = std::to_string(design.targets.size());
  row["targets_met"] = std::to_string(detail::targets_met(design));
  add_deviations(row, design);
  row["status"] = text_cell(design.status);
  row["iterations"] = std::to_string(design.iterations);
  row["evaluations"] = std::to_string(design.evaluations);
  row["seconds"] = number_cell(design.seconds);
  row["seconds_per_iteration"] = number_cell(design.seconds_per_iteration);
  if (design.published) {
    row["published_iterations"] = number_cell(design.published->iterations);
    row["published_seconds_per_iteration"] = number_cell(design.published->seconds_per_iteration);
    row["published_seconds"] = number_cell(detail::published_seconds(design));
  }
  row["peak_memory_bytes"] = number_cell(entry.peak_memory);
  row["threads"] = number_cell(entry.threads);
  return line(row);
}

std::string target_line(const ReportEntry& entry, const ReportTarget& target)
{
  Row row = about(entry, "target");
  row["quantity"] = text_cell(entry.design->quantity);
  row["unit"] = text_cell(entry.unit);
  row["direction_deg"] = number_cell(target.direction_deg);
  row["target"] = number_cell(target.target);
  row["aim"] = to_string(target.aim);
  row["published"] = number_cell(target.published);
  row["initial"] = number_cell(target.initial);
  row["provisional"] = number_cell(target.provisional);
  row["recomputed"] = number_cell(target.recomputed);
  row["deviation"] = number_cell(detail::miss_of(target));
  row["rechecked"] = number_cell(target.rechecked);
  row["recheck_change"] = number_cell(difference(target.rechecked, target.recomputed));
  row["better_state"] = truth(target.better_state);
  row["met"] = truth(target.met);
  return line(row);
}

std::string limits_lines(const ReportEntry& entry)
{
  Row head = about(entry, "limits");
  head["unit"] = text_cell(entry.unit);
  head["peak_memory_bytes"] = number_cell(entry.peak_memory);
  head["threads"] = number_cell(entry.threads);
  std::string out = line(head);
  for (const ProfilePoint& point : entry.run.profiles) {
    Row row = about(entry, "profile");
    row["unit"] = text_cell(entry.unit);
    row["direction_deg"] = number_cell(point.direction_deg);
    row["e_s"] = number_cell(point.e_s);
    row["e_c"] = number_cell(point.e_c);
    row["eta"] = number_cell(point.eta);
    out += line(row);
  }
  return out;
}

std::string total_line(const detail::ReportTotals& sums)
{
  Row row{{"row", "total"}};
  row["targets"] = std::to_string(sums.targets);
  row["targets_met"] = std::to_string(sums.met);
  row["iterations"] = std::to_string(sums.iterations);
  row["evaluations"] = std::to_string(sums.evaluations);
  row["seconds"] = number_cell(sums.seconds);
  if (sums.published > 0) row["published_seconds"] = number_cell(sums.published_seconds);
  row["peak_memory_bytes"] = number_cell(sums.peak_memory);
  return line(row);
}

}  // namespace

std::string report_csv(std::span<const ReportEntry> entries)
{
  std::string out = detail::csv_line({columns.begin(), columns.end()});
  for (const ReportEntry& entry : entries) {
    if (!entry.design) {
      out += limits_lines(entry);
      continue;
    }
    out += design_line(entry);
    for (const ReportTarget& target : entry.design->targets) out += target_line(entry, target);
  }
  const detail::ReportTotals sums = detail::totals(entries);
  return sums.designs > 0 ? out + total_line(sums) : out;
}

}  // namespace hauberk
