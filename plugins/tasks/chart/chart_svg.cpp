#include "pictures/decade_panel.hpp"
#include "pictures/strokes.hpp"
#include "tasks/chart/chart_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

using detail::DecadeFrame;
using detail::DecadeLine;
using detail::DecadePanel;
using detail::Point2;
using detail::Svg;

// In units of the drawing.
constexpr double left = 56.0, right = 20.0, head = 92.0, foot = 52.0, between = 34.0, legend_row = 18.0,
                 legend_column = 200.0, caption = 20.0, note_row = 15.0, bottom = 14.0;
constexpr DecadeFrame frame{380.0, 300.0};
constexpr double panel_width = left + frame.width + right, panel_height = between + frame.height + foot;
constexpr std::size_t most_columns = 2, most_letters = 130;
/// What clocks and counters cannot tell from nothing.
constexpr double least_seconds = 1e-9, least_evaluations = 1.0;

double cost_of(const PrecisionPoint& point, PrecisionCost cost)
{
  if (cost == PrecisionCost::seconds) return std::max(point.median_seconds().value_or(0.0), least_seconds);
  return std::max(static_cast<double>(point.first->evaluations), least_evaluations);
}

/// The line of a method, without points. Markers come round in another order than colours.
DecadeLine method_line(const PrecisionChart& chart, std::size_t method)
{
  return {chart.methods[method].name,
          detail::distinct_stroke(method),
          method + method / detail::stroke_colours,
          {}};
}

DecadePanel panel_of(const PrecisionChart& chart, std::size_t scene, PrecisionCost cost)
{
  const PrecisionScene& s = chart.scenes[scene];
  DecadePanel panel;
  panel.title = s.name;
  panel.x_label = cost == PrecisionCost::seconds ? fmt::format("seconds, median of {}", chart.repeats)
                                                 : "evaluations of closest points";
  panel.y_label = "error of 1 + value";
  if (const std::optional<double> floor = s.floor()) {
    panel.floor = std::max(*floor, least_error);
    panel.floor_label = fmt::format("error estimate of the reference, {:.1e}", *floor);
  }
  const std::vector<const PrecisionPoint*> shown = shown_points(chart, scene);
  for (std::size_t m = 0; m < chart.methods.size(); ++m) {
    DecadeLine line = method_line(chart, m);
    for (const PrecisionPoint* p : shown) {
      if (p->method != m) continue;
      const bool front = cost == PrecisionCost::seconds ? p->pareto : p->pareto_work;
      line.points.push_back({cost_of(*p, cost), std::max(*p->error, least_error), front});
    }
    std::stable_sort(line.points.begin(), line.points.end(),
                     [](const auto& a, const auto& b) { return a.x < b.x; });
    if (!line.points.empty()) panel.lines.push_back(std::move(line));
  }
  return panel;
}

/// A line for each point that has no place in the picture.
std::vector<std::string> notes(const PrecisionChart& chart)
{
  std::vector<std::string> out;
  for (const PrecisionPoint& p : chart.points) {
    if (p.error) continue;
    std::string text = point_name(chart, p) + ": " + to_string(p.status);
    if (!p.message.empty()) text += ": " + p.message;
    if (text.size() > most_letters) text = text.substr(0, most_letters) + "...";
    out.push_back(std::move(text));
  }
  return out;
}

std::string subtitle(const PrecisionChart& chart, PrecisionCost cost)
{
  if (cost == PrecisionCost::evaluations) return "error against work, however fast the machine";
  const int threads = chart.threads.front();
  const std::string with = threads == 0   ? "all processors"
                           : threads == 1 ? "one thread"
                                          : fmt::format("{} threads", threads);
  return "error against time, with " + with;
}

std::size_t rows_of(std::size_t count, std::size_t columns) { return (count + columns - 1) / columns; }

void draw_legend(Svg& svg, const PrecisionChart& chart, double y, std::size_t columns)
{
  for (std::size_t m = 0; m < chart.methods.size(); ++m) {
    const std::size_t column = m % columns, row = m / columns;
    const Point2 corner{left + legend_column * static_cast<double>(column),
                        y + legend_row * static_cast<double>(row)};
    draw_decade_legend(svg, corner, method_line(chart, m));
  }
}

}  // namespace

std::string chart_svg(const PrecisionChart& chart, PrecisionCost cost, const std::string& title)
{
  const std::size_t columns = std::clamp<std::size_t>(chart.scenes.size(), 1, most_columns);
  const std::vector<std::string> unplaced = notes(chart);
  const double width = std::max(panel_width * static_cast<double>(columns), 640.0);
  const auto legend_columns = static_cast<std::size_t>((width - left) / legend_column);
  const double legend = legend_row * static_cast<double>(rows_of(chart.methods.size(), legend_columns));
  const double top = head + legend;
  const double below = top + panel_height * static_cast<double>(rows_of(chart.scenes.size(), columns));
  Svg svg(width, below + note_row * static_cast<double>(unplaced.size()) + bottom);
  svg.text({left, 24.0}, title, 16.0, "start", true);
  svg.text({left, 42.0}, subtitle(chart, cost), 12.0);
  svg.circle({left + 8.0, 59.0}, 8.0, "none", {"#000", 2.2, ""});
  svg.text({left + 24.0, 63.0}, "Pareto front: nothing else is both as exact and as cheap", 11.0);
  draw_legend(svg, chart, 84.0, legend_columns);
  for (std::size_t k = 0; k < chart.scenes.size(); ++k) {
    const std::size_t column = k % columns, row = k / columns;
    const Point2 corner{left + panel_width * static_cast<double>(column),
                        top + caption + panel_height * static_cast<double>(row)};
    draw_decade_panel(svg, corner, frame, panel_of(chart, k, cost));
  }
  for (std::size_t k = 0; k < unplaced.size(); ++k)
    svg.text({left, below + note_row * static_cast<double>(k)}, unplaced[k], 11.0);
  return svg.str();
}

}  // namespace hauberk
