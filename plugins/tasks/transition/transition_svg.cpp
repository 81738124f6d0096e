#include "pictures/line_panel.hpp"
#include "pictures/strokes.hpp"
#include "tasks/transition/transition_results.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

using detail::Line;
using detail::LineFrame;
using detail::LinePanel;
using detail::Stroke;
using detail::Svg;

// In units of the drawing.
constexpr double left = 70.0, between = 92.0, top = 108.0, panel_step = 172.0, bottom = 52.0, right = 24.0,
                 legend_word = 92.0;
constexpr LineFrame plot{0.0, 1.0, 400.0, 130.0};

/// `auto` is one of the others, so it is drawn as wide dots on top of it.
Stroke curve_stroke(const std::string& contact)
{
  if (contact == "nearest") return {"#c55a11", 1.6, "8,4"};
  if (contact == "published") return {"#2e7d32", 1.6, "2,3"};
  if (contact == "arc") return {"#1f4e79", 2.0, ""};
  return {"#111", 3.6, "3,15"};
}

double place(const TransitionPath& path, const TransitionSample& sample)
{
  return path.rotates ? sample.degrees : sample.shift;
}

int contact_count(const TransitionPath& path)
{
  int count = 0;
  for (const TransitionSample& sample : path.samples) {
    for (const TransitionMinimum& m : sample.minima) count = std::max(count, m.contact + 1);
  }
  return count;
}

/// A line per contact.
template <typename F>
std::vector<Line> contact_lines(const TransitionPath& path, F&& quantity)
{
  std::vector<Line> lines;
  for (int k = 0; k < contact_count(path); ++k) {
    Line line{fmt::format("contact {}", k), detail::distinct_stroke(static_cast<std::size_t>(k)), {}};
    for (const TransitionSample& sample : path.samples) {
      std::optional<double> value;
      for (const TransitionMinimum& m : sample.minima) {
        if (m.contact == k) value = quantity(m);
      }
      line.points.emplace_back(place(path, sample), value);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// A line per formulation.
template <typename F>
std::vector<Line> curve_lines(const TransitionPath& path, F&& quantity)
{
  std::vector<Line> lines;
  for (std::size_t c = 0; c < path.curves.size(); ++c) {
    const TransitionCurve& curve = path.curves[c];
    const bool same = curve.contact == curve.formulation;
    Line line{same ? curve.contact : fmt::format("{} (here {})", curve.contact, curve.formulation),
              curve_stroke(curve.contact),
              {}};
    for (const TransitionSample& sample : path.samples)
      line.points.emplace_back(place(path, sample), quantity(sample.forces[c]));
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<LinePanel> panels(const TransitionResult& result, const TransitionPath& path)
{
  const std::string unit = result.length_unit;
  std::vector<LinePanel> out(5);
  out[0].title = fmt::format("distance of nearest points ({})", unit);
  out[0].lines = contact_lines(path, [](const auto& m) { return std::optional(m.distance); });
  out[0].levels = {{result.activation_distance + result.clearance, "activation distance"}};
  out[1].title = fmt::format("smallest eigenvalue, published ({}\u00b2)", unit);
  out[1].lines = contact_lines(path, [](const auto& m) { return m.eigenvalue; });
  out[1].levels = {{result.eigenvalue_threshold, "faded below"}};
  out[2].title = "smallest relative curvature, times L";
  out[2].lines = contact_lines(path, [](const auto& m) { return std::optional(m.relative_curvature); });
  out[3].title = "contact energy";
  out[3].lines = curve_lines(path, [](const TransitionForce& f) { return std::optional(f.energy); });
  out[4].title = "force along the path, -dE/ds (linear below 1, then decades)";
  out[4].decades = true;
  out[4].lines = curve_lines(path, [](const TransitionForce& f) { return std::optional(f.along); });
  return out;
}

/// Contact lines of the path that has most, as many as the legend has room for.
std::vector<Line> legend_contacts(const TransitionResult& result, double width)
{
  constexpr double entry = 126.0;
  int most = 0;
  for (const TransitionPath& path : result.paths) most = std::max(most, contact_count(path));
  std::vector<Line> lines;
  for (int k = 0; k < std::min(most, static_cast<int>(width / entry)); ++k)
    lines.push_back({fmt::format("contact {}", k), detail::distinct_stroke(static_cast<std::size_t>(k)), {}});
  return lines;
}

}  // namespace

std::string transition_svg(const TransitionResult& result, const std::string& title)
{
  const double columns = static_cast<double>(std::max<std::size_t>(result.paths.size(), 1));
  Svg svg(left + columns * plot.width + (columns - 1.0) * between + right,
          top + 20.0 + 5.0 * panel_step - (panel_step - plot.height) + bottom);
  svg.text({left, 24.0}, title, 16.0, "start", true);
  svg.text({left, 40.0},
           fmt::format("activation distance {:g} {}, clearance {:g} {}", result.activation_distance,
                       result.length_unit, result.clearance, result.length_unit),
           12.0);
  svg.text({left, 62.0}, "nearest points:", 11.0);
  detail::draw_line_legend(svg, {left + legend_word, 58.0},
                           legend_contacts(result, columns * plot.width + (columns - 1.0) * between));
  svg.text({left, 82.0}, "formulations:", 11.0);
  if (!result.paths.empty()) {
    detail::draw_line_legend(
        svg, {left + legend_word, 78.0},
        curve_lines(result.paths.front(), [](const TransitionForce& f) { return std::optional(f.energy); }));
  }
  double x = left;
  for (const TransitionPath& path : result.paths) {
    LineFrame frame = plot;
    if (!path.samples.empty()) {
      frame.x_from = place(path, path.samples.front());
      frame.x_to = place(path, path.samples.back());
    }
    svg.text({x + 0.5 * plot.width, top}, path.name, 13.0, "middle", true);
    const std::vector<LinePanel> list = panels(result, path);
    double y = top + 26.0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const bool last = k + 1 == list.size();
      detail::draw_line_panel(svg, {x, y}, frame, list[k], last);
      if (last) svg.text({x + 0.5 * plot.width, y + plot.height + 32.0}, path.axis, 12.0, "middle");
      y += panel_step;
    }
    x += plot.width + between;
  }
  return svg.str();
}

}  // namespace hauberk
