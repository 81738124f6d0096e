#include "pictures/line_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk::detail {
namespace {

constexpr double label_size = 10.0;
constexpr int most_ticks = 5;
/// A level farther beyond the values than this part of their span is left out.
constexpr double level_reach = 0.35;

struct Range {
  double from = 0.0, to = 1.0;
};

/// Where a value stands on the axis.
double scaled(const LinePanel& panel, double y) { return panel.decades ? std::asinh(y) : y; }

Range values_of(const LinePanel& panel)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Line& line : panel.lines) {
    for (const auto& [x, y] : line.points) {
      if (!y || !std::isfinite(*y)) continue;
      low = std::min(low, scaled(panel, *y));
      high = std::max(high, scaled(panel, *y));
    }
  }
  if (low > high) return {};
  if (panel.from_zero && low >= 0.0) low = 0.0;
  // Values that differ by less are one line: ticks between them would have no digits that tell them apart.
  constexpr double same = 1e-6;
  if (high - low <= same * std::max(std::abs(low), std::abs(high))) low = high = 0.5 * (low + high);
  const double span = high > low ? high - low : std::max(std::abs(high), 1.0);
  for (const Level& level : panel.levels) {
    const double y = scaled(panel, level.value);
    if (y > high && y < high + level_reach * span) high = y;
  }
  const double margin = 0.06 * (high > low ? high - low : span);
  return {low < 0.0 || low > 0.0 ? low - margin : low, high + margin};
}

class Plot {
 public:
  Plot(Svg& svg, Point2 corner, const LineFrame& frame, const LinePanel& panel)
      : svg_(svg), corner_(corner), frame_(frame), panel_(panel), y_(values_of(panel))
  {
  }

  Point2 at(double x, double y) const
  {
    return {corner_.x + frame_.width * (x - frame_.x_from) / (frame_.x_to - frame_.x_from),
            corner_.y + frame_.height * (y_.to - scaled(panel_, y)) / (y_.to - y_.from)};
  }

  void axes(bool numbered) const
  {
    const double right = corner_.x + frame_.width, bottom = corner_.y + frame_.height;
    for (const double y : panel_.decades ? powers() : ticks(y_.from, y_.to)) {
      const Point2 p = at(frame_.x_from, y);
      svg_.line({corner_.x, p.y}, {right, p.y}, {y == 0.0 ? "#888" : "#ddd", 0.7, ""});
      svg_.text({corner_.x - 5.0, p.y + 3.5}, fmt::format("{:.4g}", y), label_size, "end");
    }
    for (const double x : ticks(std::min(frame_.x_from, frame_.x_to), std::max(frame_.x_from, frame_.x_to))) {
      const Point2 p = at(x, 0.0);
      svg_.line({p.x, bottom}, {p.x, corner_.y}, {"#eee", 0.7, ""});
      svg_.line({p.x, bottom}, {p.x, bottom + 4.0}, {"#333", 0.8, ""});
      if (numbered) svg_.text({p.x, bottom + 15.0}, fmt::format("{:.4g}", x), label_size, "middle");
    }
    const std::array<Point2, 4> box{corner_, {right, corner_.y}, {right, bottom}, {corner_.x, bottom}};
    svg_.path(box, true, {"#333", 0.8, ""});
  }

  void level(const Level& level) const
  {
    const double y = scaled(panel_, level.value);
    if (y < y_.from || y > y_.to) return;
    const Point2 a = at(frame_.x_from, level.value), b = at(frame_.x_to, level.value);
    svg_.line(a, b, {"#555", 0.8, "1,3"});
    svg_.text({b.x - 4.0, a.y - 3.0}, level.label, label_size, "end", false, true, "#555");
  }

  void line(const Line& line) const
  {
    std::vector<Point2> run;
    const auto finish = [&] {
      if (run.size() > 1) svg_.path(run, false, line.stroke);
      if (run.size() == 1) svg_.circle(run.front(), 1.5, line.stroke.colour, {line.stroke.colour, 0.5, ""});
      run.clear();
    };
    for (const auto& [x, y] : line.points) {
      if (y && std::isfinite(*y))
        run.push_back(at(x, *y));
      else
        finish();
    }
    finish();
  }

 private:
  static std::vector<double> ticks(double from, double to)
  {
    std::vector<double> out;
    const double step = tick_step(to - from, most_ticks);
    for (double k = std::ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; k += 1.0)
      out.push_back(k == 0.0 ? 0.0 : k * step);
    return out;
  }

  /// 0 and the powers of ten of either sign within the range.
  std::vector<double> powers() const
  {
    std::vector<double> out{0.0};
    for (double power = 1.0; std::asinh(power) <= std::max(y_.to, -y_.from); power *= 10.0) {
      if (std::asinh(power) <= y_.to) out.push_back(power);
      if (std::asinh(-power) >= y_.from) out.push_back(-power);
    }
    return out;
  }

  Svg& svg_;
  Point2 corner_;
  const LineFrame& frame_;
  const LinePanel& panel_;
  Range y_;
};

}  // namespace

double tick_step(double span, int most)
{
  const double power = std::pow(10.0, std::floor(std::log10(span / most)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    if (span / (factor * power) <= most) return factor * power;
  }
  return 10.0 * power;
}

void draw_line_panel(Svg& svg, Point2 corner, const LineFrame& frame, const LinePanel& panel, bool numbered)
{
  svg.text({corner.x, corner.y - 6.0}, panel.title, 12.0, "start", true);
  const Plot plot(svg, corner, frame, panel);
  plot.axes(numbered);
  for (const Level& level : panel.levels) plot.level(level);
  for (const Line& line : panel.lines) plot.line(line);
}

double draw_line_legend(Svg& svg, Point2 corner, const std::vector<Line>& lines)
{
  constexpr double sample = 40.0, letter = 5.8, space = 22.0;
  double x = corner.x;
  for (const Line& line : lines) {
    svg.line({x, corner.y}, {x + sample, corner.y}, line.stroke);
    svg.text({x + sample + 6.0, corner.y + 4.0}, line.label, 11.0);
    x += sample + 6.0 + letter * static_cast<double>(line.label.size()) + space;
  }
  return x;
}

}  // namespace hauberk::detail
