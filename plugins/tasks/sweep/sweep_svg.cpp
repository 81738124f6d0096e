#include "document/json_text.hpp"
#include "pictures/line_panel.hpp"
#include "pictures/strokes.hpp"
#include "tasks/sweep/sweep_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

using detail::Line;
using detail::LineFrame;
using detail::LinePanel;
using detail::Svg;
namespace json = boost::json;

// In units of the drawing.
constexpr double left = 78.0, right = 24.0, top = 78.0, between = 46.0, legend_row = 18.0, foot = 52.0,
                 plot_width = 520.0, plot_height = 260.0, legend_column = 260.0;

/// Place of a row on the x axis: its number, or its rank among values that are no numbers.
double place(const SweepTable& table, const SweepRow& row)
{
  const json::value& value = row.values.front();
  if (value.is_number()) {
    const double x = value.to_number<double>();
    return table.axes.front().logarithmic ? std::log10(x) : x;
  }
  double rank = 0.0;
  std::vector<const json::value*> seen;
  for (const SweepRow& other : table.rows) {
    const json::value* v = &other.values.front();
    if (*v == value) return rank;
    if (std::none_of(seen.begin(), seen.end(), [v](const json::value* s) { return *s == *v; })) {
      seen.push_back(v);
      rank += 1.0;
    }
  }
  return rank;
}

/// "r = 0.7, preset = fast": values of all axes but the first; empty when there is one only.
std::string combination(const SweepTable& table, const SweepRow& row)
{
  std::string out;
  for (std::size_t k = 1; k < row.values.size(); ++k) {
    const json::value& v = row.values[k];
    std::string text = v.is_number()   ? fmt::format("{:.6g}", v.to_number<double>())
                       : v.is_string() ? std::string(v.as_string())
                                       : write_json(v);
    text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
    out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", table.axes[k].name, text);
  }
  return out;
}

/// A line per combination of the other axes, named `name` and the combination. It has a gap at rows that are
/// not done: what is measured of them is where a computation gave up, no answer.
std::vector<Line> lines_of(const SweepTable& table, std::size_t measure, const std::string& name)
{
  std::vector<Line> lines;
  for (const SweepRow& row : table.rows) {
    const std::string other = combination(table, row);
    const std::string label = other.empty() ? name : other;
    auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return l.label == label; });
    if (line == lines.end()) {
      lines.push_back({label, detail::distinct_stroke(lines.size()), {}});
      line = lines.end() - 1;
    }
    std::optional<double> value;
    if (row.status == RowStatus::done && measure < row.measured.size()) value = row.measured[measure];
    line->points.emplace_back(place(table, row), value);
  }
  for (Line& line : lines) {
    std::stable_sort(line.points.begin(), line.points.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  return lines;
}

std::vector<LinePanel> panels(const SweepTable& table)
{
  std::vector<LinePanel> out;
  if (table.axes.size() == 1) out.emplace_back();
  for (std::size_t m = 0; m < table.measures.size(); ++m) {
    std::vector<Line> lines = lines_of(table, m, table.measures[m].name);
    if (table.axes.size() > 1) {
      out.push_back({table.measures[m].name, std::move(lines), {}});
      continue;
    }
    lines.front().stroke = detail::distinct_stroke(m);
    out.front().lines.push_back(std::move(lines.front()));
  }
  return out;
}

LineFrame frame_of(const SweepTable& table)
{
  LineFrame frame{0.0, 1.0, plot_width, plot_height};
  bool first = true;
  for (const SweepRow& row : table.rows) {
    const double x = place(table, row);
    frame.x_from = first ? x : std::min(frame.x_from, x);
    frame.x_to = first ? x : std::max(frame.x_to, x);
    first = false;
  }
  // Also where values differ by rounding alone: between them there is no place for a tick.
  if (!(frame.x_to - frame.x_from > 1e-9 * std::max(std::abs(frame.x_from), std::abs(frame.x_to)))) {
    frame.x_from -= 0.5;
    frame.x_to += 0.5;
  }
  return frame;
}

/// Rows of two entries; returns how many.
double draw_legend(Svg& svg, double y, const std::vector<Line>& lines)
{
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double column = k % 2 == 0 ? 0.0 : 1.0, row = static_cast<double>(k / 2);
    detail::draw_line_legend(svg, {left + column * legend_column, y + row * legend_row}, {lines[k]});
  }
  return std::ceil(0.5 * static_cast<double>(lines.size()));
}

}  // namespace

std::string sweep_svg(const SweepTable& table, const std::string& title, const std::string& subtitle)
{
  const std::vector<LinePanel> list = panels(table);
  const LineFrame frame = frame_of(table);
  std::size_t most = 0;
  for (const LinePanel& panel : list) most = std::max(most, panel.lines.size());
  const double legend = legend_row * std::ceil(0.5 * static_cast<double>(most));
  const double step = legend + between + plot_height + foot;
  Svg svg(left + plot_width + right, top - 20.0 + static_cast<double>(list.size()) * step);
  svg.text({left, 24.0}, title, 16.0, "start", true);
  svg.text({left, 42.0}, subtitle, 12.0);
  double y = top;
  for (const LinePanel& panel : list) {
    draw_legend(svg, y - 8.0, panel.lines);
    const double corner = y + legend + between - 30.0;
    detail::draw_line_panel(svg, {left, corner}, frame, panel, true);
    const SweepTable::Axis& axis = table.axes.front();
    svg.text({left + 0.5 * plot_width, corner + plot_height + 32.0},
             axis.logarithmic ? "log10 of " + axis.name : axis.name, 12.0, "middle");
    y += step;
  }
  return svg.str();
}

}  // namespace hauberk
