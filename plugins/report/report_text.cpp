#include "report/markdown.hpp"
#include "report/report.hpp"
#include "report/report_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

using detail::Deviation;
using detail::MarkdownTable;

constexpr double mega = 1e6;

std::string cell(const std::optional<double>& x, const char* format)
{
  return x && std::isfinite(*x) ? fmt::format(fmt::runtime(format), *x) : "-";
}
std::string value_cell(const std::optional<double>& x) { return cell(x, "{:.5g}"); }
std::string percent_cell(const std::optional<double>& x) { return cell(x, "{:.2f}"); }
std::string signed_percent_cell(const std::optional<double>& x) { return cell(x, "{:+.2f}"); }

/// A bound is marked as one.
std::string target_cell(const ReportTarget& t)
{
  if (t.aim == Aim::reach) return value_cell(t.target);
  return value_cell(t.target) + (t.aim == Aim::no_further ? " or nearer" : " or further");
}

constexpr const char* deviations_explained =
    "Deviations of a design are differences from its targets, in per cent of the mean of its targets' "
    "magnitudes: "
    "root mean square and largest, of the limits that were recomputed from the rest state after the search. "
    "`there`: in the directions whose published values are known, for ours and theirs. The published "
    "largest one is of these, or of the published range. A target is met within 5 % of it; a bound that is kept has no"
    " deviation, and is met within a thousandth.\n\n";

constexpr const char* recheck_explained =
    "`rechecked` limits are those of the designed scene, computed apart from the design and from more "
    "starts.\n\n";

constexpr const char* costs_explained =
    "Seconds are those of all searches of a design; those per iteration of the one that gave it. Limits "
    "before and after the search are not in them. Published times are of other machines.\n\n";

std::string deviations_table(std::span<const ReportEntry> entries, const std::vector<std::string>& names,
                             const detail::ReportTotals& sums)
{
  MarkdownTable table({"design", "quantity", "targets met", "RMS %", "largest %", "published largest %",
                       "known", "RMS % there", "published RMS % there", "rechecked RMS %",
                       "largest change %"});
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (!entries[k].design) continue;
    const ReportDesign& design = *entries[k].design;
    const Deviation ours = detail::deviation(design, &ReportTarget::recomputed);
    const Deviation there = detail::deviation(design, &ReportTarget::recomputed, &ReportTarget::published);
    const Deviation theirs = detail::deviation(design, &ReportTarget::published, &ReportTarget::recomputed);
    const std::size_t missing = design.targets.size() - ours.values;
    table.row({names[k], detail::quantity_text(entries[k]),
               fmt::format("{} of {}", detail::targets_met(design), design.targets.size()),
               percent_cell(ours.rms) + (missing > 0 ? fmt::format(" ({} without value)", missing) : ""),
               percent_cell(ours.worst), percent_cell(detail::published_worst(design)),
               theirs.values > 0 ? fmt::format("{} of {}", theirs.values, design.targets.size()) : "-",
               percent_cell(there.rms), percent_cell(theirs.rms),
               percent_cell(detail::deviation(design, &ReportTarget::rechecked).rms),
               percent_cell(detail::recheck_change(design))});
  }
  table.row({"sum", "", fmt::format("{} of {}", sums.met, sums.targets), "", "", "", "", "", "", "", ""});
  return table.text();
}

std::string costs_table(std::span<const ReportEntry> entries, const std::vector<std::string>& names,
                        const detail::ReportTotals& sums)
{
  const auto memory = [](const std::optional<double>& bytes) {
    return cell(bytes ? std::optional(*bytes / mega) : std::nullopt, "{:.1f}");
  };
  MarkdownTable table({"design", "status", "iterations", "evaluations", "seconds", "s/iteration",
                       "published iterations", "published s/iteration", "published seconds",
                       "peak memory, MB", "threads"});
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (!entries[k].design) continue;
    const ReportDesign& design = *entries[k].design;
    const PublishedDesign published = design.published.value_or(PublishedDesign{});
    table.row({names[k], design.status, std::to_string(design.iterations), std::to_string(design.evaluations),
               cell(design.seconds, "{:.1f}"), cell(design.seconds_per_iteration, "{:.3f}"),
               cell(published.iterations, "{:g}"), cell(published.seconds_per_iteration, "{:g}"),
               cell(detail::published_seconds(design), "{:.0f}"), memory(entries[k].peak_memory),
               cell(entries[k].threads, "{:g}")});
  }
  table.row({"sum", "", std::to_string(sums.iterations), std::to_string(sums.evaluations),
             cell(sums.seconds, "{:.1f}"), "", "", "",
             sums.published > 0 ? cell(sums.published_seconds, "{:.0f}") : "-",
             memory(sums.peak_memory) + (sums.designs > 1 ? " (largest)" : ""), ""});
  return table.text();
}

std::string design_section(const ReportEntry& entry)
{
  const ReportDesign& design = *entry.design;
  std::string out;
  if (design.published) {
    out += "Published: " + detail::markdown_text(design.published->source);
    if (design.published->lowest && design.published->highest)
      out += fmt::format("; values from {} to {}", value_cell(design.published->lowest),
                         value_cell(design.published->highest));
    out += ".\n\n";
  }
  MarkdownTable table({"direction", "target", "published", "initial", "provisional", "recomputed",
                       "deviation, % of target", "rechecked", "change, % of target", "met"});
  for (const ReportTarget& t : design.targets) {
    table.row({fmt::format("{:g}", t.direction_deg), target_cell(t), value_cell(t.published),
               value_cell(t.initial), value_cell(t.provisional),
               value_cell(t.recomputed) + (t.better_state ? "\u2020" : ""),
               signed_percent_cell(detail::relative_percent(0.0, detail::miss_of(t), t.target)),
               value_cell(t.rechecked),
               signed_percent_cell(detail::relative_percent(t.recomputed, t.rechecked, t.target)),
               t.met ? "yes" : "no"});
  }
  const bool further = std::any_of(design.targets.begin(), design.targets.end(),
                                   [](const ReportTarget& t) { return t.better_state; });
  return out + table.text() + (further ? "\n\u2020 further than where the first start from rest led\n" : "");
}

/// The limit, or why there is none.
std::string limit_cell(const ReportEntry& entry, double direction, const std::string& sense)
{
  for (const LimitResult& limit : entry.run.limits) {
    if (limit.direction.degrees() != direction || limit.sense != sense) continue;
    return limit.status == LimitStatus::locked ? value_cell(limit.value) : to_string(limit.status);
  }
  return "-";
}

std::string limits_section(const ReportEntry& entry)
{
  const bool strain = entry.unit == "strain";
  std::vector<std::string> header{"direction", entry.positive, entry.negative};
  if (strain) header.emplace_back("eta");
  MarkdownTable table(header);
  for (const ProfilePoint& point : entry.run.profiles) {
    std::vector<std::string> row{fmt::format("{:g}", point.direction_deg),
                                 limit_cell(entry, point.direction_deg, entry.positive),
                                 limit_cell(entry, point.direction_deg, entry.negative)};
    if (strain) row.push_back(value_cell(point.eta));
    table.row(std::move(row));
  }
  return table.text();
}

}  // namespace

std::string report_text(std::span<const ReportEntry> entries)
{
  const std::vector<std::string> names = detail::distinct_names(entries);
  const detail::ReportTotals sums = detail::totals(entries);
  std::string out = fmt::format("# Report\n\n![Limits against direction]({})\n\n", report_picture_file);
  if (sums.designs > 0) {
    const bool rechecked = std::any_of(entries.begin(), entries.end(), [](const ReportEntry& entry) {
      return entry.design && entry.design->rechecked;
    });
    out += std::string("## Deviation from targets\n\n") + deviations_explained;
    if (rechecked) out += recheck_explained;
    out += deviations_table(entries, names, sums) + "\n## Cost\n\n" + costs_explained +
           costs_table(entries, names, sums);
    if (sums.published > 0 && sums.seconds_of_published > 0.0)
      out += fmt::format("\nThe {} designs with published times: {:.0f} s here, {:.0f} s published.\n",
                         sums.published, sums.seconds_of_published, sums.published_seconds);
    out += "\n";
  }
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const ReportEntry& entry = entries[k];
    const std::string what =
        entry.design ? "Design of " + detail::quantity_text(entry) : "Limits (" + entry.unit + ")";
    out += fmt::format("## {}\n\n{}, {}\n\n{}\n", detail::markdown_text(names[k]), what,
                       detail::markdown_text(entry.file),
                       entry.design ? design_section(entry) : limits_section(entry));
  }
  out.pop_back();
  return out;
}

}  // namespace hauberk
