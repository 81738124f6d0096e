#include "pictures/profile_panels.hpp"
#include "report/report.hpp"
#include "report/report_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

using detail::Curve;
using detail::Panel;

constexpr std::size_t panels_per_row = 3;
constexpr double header = 46.0, margin = 16.0;
constexpr double row_gap = 14.0;

std::string subtitle(const ReportEntry& entry)
{
  if (!entry.design) return entry.positive + ", " + entry.negative + " (" + entry.unit + ")";
  const ReportDesign& design = *entry.design;
  std::string out = design.quantity == "eta" ? "\u03b7" : design.quantity + " (" + entry.unit + ")";
  if (const auto rms = detail::deviation(design, &ReportTarget::recomputed).rms)
    out += fmt::format(": RMS deviation {:.1f} %, {} of {} met", *rms, detail::targets_met(design),
                       design.targets.size());
  return out;
}

/// A curve without values, drawn in black.
Curve published_curve(const std::string& label, const char* dash, bool joined)
{
  return {.label = label,
          .stroke = {"#000", 1.0, dash},
          .marker = Curve::Marker::none,
          .joined = joined,
          .points = {},
          .holes = {},
          .endless = {},
          .hollow = {},
          .bars = {},
          .behind = true};
}

/// Behind ours: the published profile as a dotted curve, what was measured of printed samples as bars.
void add_published_profile(Panel& panel, const PublishedDesign& published)
{
  std::vector<Curve> behind;
  Curve profile = published_curve("published profile", "1.5,3", true);
  for (const auto& [degrees, value] : published.profile)
    profile.points.emplace_back(degrees, std::abs(value));
  Curve measured = published_curve("measured of printed samples", "", false);
  measured.stroke = {"#2e8b57", 2.0, ""};
  for (const MeasuredRange& range : published.measured)
    measured.bars.push_back({range.direction_deg, range.lowest, range.highest});
  if (!profile.points.empty()) behind.push_back(std::move(profile));
  if (!measured.bars.empty()) behind.push_back(std::move(measured));
  panel.curves.insert(panel.curves.begin(), behind.begin(), behind.end());
}

/// Values at the targets as crosses, a range as two dashed rings.
void add_published(Panel& panel, const ReportDesign& design)
{
  std::vector<std::pair<double, double>> values;
  for (const ReportTarget& target : design.targets) {
    if (target.published) values.emplace_back(target.direction_deg, *target.published);
  }
  detail::add_marks(panel, "published", Curve::Marker::cross, "#000", values);
  if (!design.published) return;
  add_published_profile(panel, *design.published);
  for (const auto& [label, end] : {std::pair{"published, lowest", design.published->lowest},
                                   std::pair{"published, highest", design.published->highest}}) {
    if (!end) continue;
    Curve ring = published_curve(label, "2,4", true);
    for (int degrees = 0; degrees < 180; degrees += 5) ring.points.emplace_back(degrees, std::abs(*end));
    panel.curves.push_back(std::move(ring));
  }
}

Panel panel_of(const ReportEntry& entry, const std::string& name)
{
  PlotLabels labels;
  labels.positive = entry.positive;
  labels.negative = entry.negative;
  labels.unit = entry.unit;
  labels.before = "initial";
  labels.after = "optimised";
  detail::ProfilePanels both = detail::profile_panels(entry.run, labels);
  Panel out = std::move(entry.design && entry.design->quantity == "eta" ? both.eta : both.limits);
  out.title = name;
  out.subtitle = subtitle(entry);
  if (!entry.design) return out;
  add_published(out, *entry.design);
  return out;
}

}  // namespace

std::string report_svg(std::span<const ReportEntry> entries)
{
  const std::vector<std::string> names = detail::distinct_names(entries);
  std::vector<std::vector<Panel>> rows;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k % panels_per_row == 0) rows.emplace_back();
    rows.back().push_back(panel_of(entries[k], names[k]));
  }
  std::size_t columns = 1;
  std::vector<double> heights;
  double height = header + margin;
  for (const std::vector<Panel>& row : rows) {
    std::size_t legend = 0;
    for (const Panel& panel : row) legend = std::max(legend, panel.curves.size());
    columns = std::max(columns, row.size());
    heights.push_back(detail::panel_height(legend) + row_gap);
    height += heights.back();
  }
  detail::Svg svg(detail::panel_width * static_cast<double>(columns), height);
  const bool designs = std::any_of(entries.begin(), entries.end(),
                                   [](const ReportEntry& entry) { return entry.design.has_value(); });
  svg.text({0.5 * detail::panel_width * static_cast<double>(columns), 28.0},
           designs ? "Designed limits against direction" : "Limits against direction", 18, "middle", true);
  double y = header;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    double x = 0.0;
    for (const Panel& panel : rows[r]) {
      detail::draw_panel(svg, {x, y}, panel);
      x += detail::panel_width;
    }
    y += heights[r];
  }
  return svg.str();
}

}  // namespace hauberk
