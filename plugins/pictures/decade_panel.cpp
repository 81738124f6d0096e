#include "pictures/decade_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hauberk::detail {
namespace {

constexpr double label_size = 10.0, half = 4.0, ring = 8.0, ring_width = 2.2;
constexpr std::size_t shapes = 8;
/// Numbers stand at every decade up to so many, beyond at every other one and so on.
constexpr int most_numbers = 9;
/// Lines stand at 2 to 9 times a power of ten as well where there are no more decades than this.
constexpr int most_divided = 3;

/// Exponents of ten.
struct Decades {
  int from = 0, to = 1;

  double part(double x) const { return (std::log10(x) - from) / (to - from); }
  bool divided() const { return to - from <= most_divided; }
  int step() const { return 1 + (to - from) / (most_numbers + 1); }
};

Decades decades_of(const std::vector<double>& values)
{
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  // Rounding of the logarithm of a power of ten must not add a decade.
  constexpr double slip = 1e-9;
  Decades out;
  out.from = static_cast<int>(std::floor(std::log10(*least) + slip));
  out.to = static_cast<int>(std::ceil(std::log10(*most) - slip));
  if (out.to <= out.from) out.to = out.from + 1;
  return out;
}

class Plot {
 public:
  Plot(Svg& svg, Point2 corner, const DecadeFrame& frame, const DecadePanel& panel)
      : svg_(svg), corner_(corner), frame_(frame)
  {
    std::vector<double> x, y;
    for (const DecadeLine& line : panel.lines) {
      for (const DecadePoint& p : line.points) {
        x.push_back(p.x);
        y.push_back(p.y);
      }
    }
    if (panel.floor) y.push_back(*panel.floor);
    x_ = decades_of(x);
    y_ = decades_of(y);
  }

  void axes() const
  {
    const double right = corner_.x + frame_.width, bottom = corner_.y + frame_.height;
    for (int k = y_.from; k <= y_.to; ++k) {
      const double y = at(1.0, std::pow(10.0, k)).y;
      svg_.line({corner_.x, y}, {right, y}, {"#ddd", 0.7, ""});
      if ((k - y_.from) % y_.step() == 0)
        svg_.text({corner_.x - 5.0, y + 3.5}, fmt::format("1e{}", k), label_size, "end");
    }
    for (int k = x_.from; k <= x_.to; ++k) {
      for (int m = 2; x_.divided() && k < x_.to && m < 10; ++m) {
        const double minor = at(m * std::pow(10.0, k), 1.0).x;
        svg_.line({minor, corner_.y}, {minor, bottom}, {"#f2f2f2", 0.7, ""});
      }
      const double x = at(std::pow(10.0, k), 1.0).x;
      svg_.line({x, corner_.y}, {x, bottom + 4.0}, {"#ddd", 0.7, ""});
      if ((k - x_.from) % x_.step() == 0)
        svg_.text({x, bottom + 16.0}, fmt::format("1e{}", k), label_size, "middle");
    }
    const std::array<Point2, 4> box{corner_, {right, corner_.y}, {right, bottom}, {corner_.x, bottom}};
    svg_.path(box, true, {"#333", 0.8, ""});
  }

  void floor(double level, const std::string& label) const
  {
    const double y = at(1.0, level).y, right = corner_.x + frame_.width;
    svg_.line({corner_.x, y}, {right, y}, {"#555", 1.0, "1,3"});
    svg_.text({right - 4.0, y - 3.0}, label, label_size, "end", false, true, "#555");
  }

  void line(const DecadeLine& line) const
  {
    std::vector<Point2> places;
    places.reserve(line.points.size());
    for (const DecadePoint& p : line.points) places.push_back(at(p.x, p.y));
    if (places.size() > 1) svg_.path(places, false, line.stroke);
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (line.points[k].ringed) svg_.circle(places[k], ring, "none", {"#000", ring_width, ""});
      draw_marker(svg_, places[k], line.marker, line.stroke);
    }
  }

 private:
  Point2 at(double x, double y) const
  {
    return {corner_.x + frame_.width * x_.part(x), corner_.y + frame_.height * (1.0 - y_.part(y))};
  }

  Svg& svg_;
  Point2 corner_;
  const DecadeFrame& frame_;
  Decades x_, y_;
};

/// Corners of a regular polygon, the first in the direction `turn` (radians, from above, clockwise).
void draw_polygon(Svg& svg, Point2 centre, int corners, double turn, const std::string& fill,
                  const Stroke& stroke)
{
  std::vector<Point2> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2.0 * std::numbers::pi * k / corners;
    points.push_back({centre.x + 1.25 * half * std::sin(angle), centre.y - 1.25 * half * std::cos(angle)});
  }
  svg.polygon(points, fill, stroke);
}

}  // namespace

void draw_marker(Svg& svg, Point2 centre, std::size_t marker, const Stroke& stroke)
{
  const std::string fill = marker / shapes % 2 == 0 ? stroke.colour : "#fff";
  const Stroke outline{stroke.colour, 1.4, ""};
  const auto [x, y] = centre;
  switch (marker % shapes) {
    case 0:
      return svg.circle(centre, half, fill, outline);
    case 1:
      return svg.square(centre, 0.9 * half, fill, outline);
    case 2:
      return draw_polygon(svg, centre, 3, 0.0, fill, outline);
    case 3:
      return draw_polygon(svg, centre, 4, 0.0, fill, outline);
    case 4:
      return draw_polygon(svg, centre, 3, std::numbers::pi, fill, outline);
    case 5:
      svg.line({x - half, y - half}, {x + half, y + half}, outline);
      return svg.line({x - half, y + half}, {x + half, y - half}, outline);
    case 6:
      svg.line({x - half, y}, {x + half, y}, outline);
      return svg.line({x, y - half}, {x, y + half}, outline);
    default:
      return svg.line({x - half, y}, {x + half, y}, {stroke.colour, 3.0, ""});
  }
}

void draw_decade_panel(Svg& svg, Point2 corner, const DecadeFrame& frame, const DecadePanel& panel)
{
  svg.text({corner.x, corner.y - 8.0}, panel.title, 13.0, "start", true);
  const Plot plot(svg, corner, frame, panel);
  plot.axes();
  if (panel.floor) plot.floor(*panel.floor, panel.floor_label);
  for (const DecadeLine& line : panel.lines) plot.line(line);
  const double below = corner.y + frame.height + 34.0;
  svg.text({corner.x + 0.5 * frame.width, below}, panel.x_label, 12.0, "middle");
  svg.text({corner.x + frame.width, corner.y - 8.0}, panel.y_label, 12.0, "end");
}

void draw_decade_legend(Svg& svg, Point2 corner, const DecadeLine& line)
{
  constexpr double sample = 40.0;
  svg.line(corner, {corner.x + sample, corner.y}, line.stroke);
  draw_marker(svg, {corner.x + 0.5 * sample, corner.y}, line.marker, line.stroke);
  svg.text({corner.x + sample + 6.0, corner.y + 4.0}, line.label, 11.0);
}

}  // namespace hauberk::detail
