#include "pictures/polar_panel.hpp"

#include "pictures/angular_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hauberk::detail {
namespace {

constexpr double radius = 155.0;  ///< of the outermost ring
constexpr double title_height = 30.0;
constexpr double label_margin = 28.0;  ///< room for the degrees around the rings
constexpr double legend_line = 20.0;
constexpr double longest_join_deg = 45.0;
/// Of the median of the values, what the scale has room for; of the scale of what matters, what it has room
/// for behind that.
constexpr double far_beyond = 10.0, far_behind = 2.5;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Smallest of 1, 2, 2.5, 5 times a power of ten that divides [0, largest] into at most five rings.
double ring_step(double largest)
{
  const double raw = largest / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * power >= raw * (1.0 - 1e-12)) return factor * power;
  return 10.0 * power;
}

class Diagram {
 public:
  Diagram(Svg& svg, Point2 centre, double largest) : svg_(svg), centre_(centre)
  {
    step_ = largest > 0.0 ? ring_step(largest) : 0.2;
    rings_ = largest > 0.0 ? static_cast<int>(std::ceil(largest / step_ * (1.0 - 1e-12))) : 5;
    rings_ = std::max(rings_, 1);
  }

  /// The largest value that is drawn, and a little for rounding.
  double rim() const { return rings_ * step_ * (1.0 + 1e-12); }

  void grid() const
  {
    for (int i = 1; i <= rings_; ++i)
      svg_.circle(centre_, radius * i / rings_, "none",
                  {i == rings_ ? "#888" : "#ccc", i == rings_ ? 1.0 : 0.7, ""});
    for (int degrees = 0; degrees < 360; degrees += 30) {
      svg_.line(centre_, at(degrees, rings_ * step_), {"#ccc", 0.7, ""});
      const Point2 p = at(degrees, rings_ * step_ * (1.0 + 15.0 / radius));
      svg_.text({p.x, p.y + 4.0}, fmt::format("{}\u00b0", degrees), 11, "middle");
    }
  }

  /// On top of the curves: values along the direction between two spokes.
  void ring_labels() const
  {
    for (int i = 1; i <= rings_; ++i) {
      const Point2 p = at(75.0, step_ * i);
      svg_.text({p.x, p.y + 4.0}, fmt::format("{:.4g}", step_ * i), 10, "middle", false, true);
    }
  }

  void curve(const Curve& curve) const
  {
    if (curve.joined) join(curve);
    for (const Bar& bar : curve.bars) {
      if (bar.lowest > rim()) continue;
      const double highest = std::min(bar.highest, rim());
      for (const double turn : {0.0, 180.0})
        draw_bar(svg_, at(bar.degrees + turn, bar.lowest), at(bar.degrees + turn, highest), curve.stroke);
    }
    for (const auto& [degrees, value] : curve.points) {
      const bool hollow = std::find(curve.hollow.begin(), curve.hollow.end(), degrees) != curve.hollow.end();
      for (const double turn : {0.0, 180.0}) {
        if (value > rim())
          beyond(degrees + turn, curve);
        else if (hollow)
          svg_.circle(at(degrees + turn, value), 3.6, "#fff", {curve.stroke.colour, 1.4, ""});
        else
          draw_marker(svg_, at(degrees + turn, value), curve, outward(degrees + turn));
      }
    }
  }

  /// Infinity signs in the curve's colour, inside the outermost ring; `row` keeps those of several curves
  /// apart.
  void endless(const Curve& curve, int row) const
  {
    const double value = rings_ * step_ * (1.0 - (10.0 + 15.0 * row) / radius);
    for (const double degrees : curve.endless)
      for (const double turn : {0.0, 180.0}) {
        const Point2 p = at(degrees + turn, value);
        svg_.text({p.x, p.y + 5.0}, "\u221e", 15, "middle", true, true, curve.stroke.colour);
      }
  }

  static void draw_bar(Svg& svg, Point2 a, Point2 b, const Stroke& stroke)
  {
    svg.line(a, b, stroke);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0.0)) return;
    constexpr double half = 4.0;
    const Point2 across{-(b.y - a.y) / length * half, (b.x - a.x) / length * half};
    for (const Point2& end : {a, b})
      svg.line({end.x - across.x, end.y - across.y}, {end.x + across.x, end.y + across.y}, stroke);
  }

  /// `outward`: away from the centre, of length one.
  static void draw_marker(Svg& svg, Point2 p, const Curve& curve, Point2 outward)
  {
    switch (curve.marker) {
      case Curve::Marker::none:
        break;
      case Curve::Marker::dot:
        svg.circle(p, 2.4, curve.stroke.colour, {"#fff", 0.6, ""});
        break;
      case Curve::Marker::square:
        svg.square(p, 2.4, "#fff", {curve.stroke.colour, 1.2, ""});
        break;
      case Curve::Marker::target:
        svg.circle(p, 5.0, curve.stroke.colour, {"#fff", 1.2, ""});
        break;
      case Curve::Marker::cross:
        for (const Stroke& stroke : {Stroke{"#fff", 2.8, ""}, Stroke{curve.stroke.colour, 1.6, ""}}) {
          constexpr double half = 4.6;
          svg.line({p.x - half, p.y - half}, {p.x + half, p.y + half}, stroke);
          svg.line({p.x - half, p.y + half}, {p.x + half, p.y - half}, stroke);
        }
        break;
      case Curve::Marker::no_further:
        draw_bound(svg, p, {-outward.x, -outward.y}, curve.stroke.colour);
        break;
      case Curve::Marker::no_nearer:
        draw_bound(svg, p, outward, curve.stroke.colour);
        break;
    }
  }

  static Point2 outward(double degrees) { return {std::cos(radians(degrees)), -std::sin(radians(degrees))}; }

 private:
  Point2 at(double degrees, double value) const
  {
    const double r = radius * value / (rings_ * step_);
    const Point2 u = outward(degrees);
    return {centre_.x + r * u.x, centre_.y + r * u.y};
  }

  /// A bar across the direction at p, and an arrowhead on it.
  static void draw_bound(Svg& svg, Point2 p, Point2 allowed, const std::string& colour)
  {
    constexpr double bar = 7.0, half = 3.5, height = 11.0;
    const auto across = [&p, &allowed](double by) {
      return Point2{p.x - by * allowed.y, p.y + by * allowed.x};
    };
    const std::array<Point2, 3> corners{across(half), across(-half),
                                        Point2{p.x + height * allowed.x, p.y + height * allowed.y}};
    svg.line(across(bar), across(-bar), {"#fff", 4.0, ""});
    svg.polygon(corners, colour, {"#fff", 1.2, ""});
    svg.line(across(bar), across(-bar), {colour, 2.2, ""});
  }

  /// An arrowhead on the rim: the value is farther out.
  void beyond(double degrees, const Curve& curve) const
  {
    constexpr double half = 4.0, height = 9.0;
    const Point2 p = at(degrees, rings_ * step_), u = outward(degrees);
    const std::array<Point2, 3> corners{Point2{p.x - half * u.y, p.y + half * u.x},
                                        Point2{p.x + half * u.y, p.y - half * u.x},
                                        Point2{p.x + height * u.x, p.y + height * u.y}};
    svg_.polygon(corners, curve.stroke.colour, {"#fff", 0.8, ""});
  }

  /// Joins neighbours around the circle, in runs without interruption, as far as the scale goes.
  void join(const Curve& curve) const
  {
    struct Entry {
      double degrees, value;
      bool hole;
    };
    std::vector<Entry> entries;
    for (const double turn : {0.0, 180.0}) {
      for (const auto& [degrees, value] : curve.points) entries.push_back({degrees + turn, value, false});
      for (const double degrees : curve.holes) entries.push_back({degrees + turn, 0.0, true});
    }
    if (entries.empty()) return;
    std::sort(entries.begin(), entries.end(), [](auto& a, auto& b) { return a.degrees < b.degrees; });
    const std::size_t n = entries.size();
    const auto joined_to_next = [&](std::size_t i) {
      const Entry &a = entries[i], &b = entries[(i + 1) % n];
      const double distance = b.degrees - a.degrees + (i + 1 == n ? 360.0 : 0.0);
      return !a.hole && !b.hole && distance <= longest_join_deg + 1e-9;
    };
    std::size_t first = 0;  // just after an interruption, or anywhere when there is none
    while (first < n && joined_to_next((first + n - 1) % n)) ++first;
    const bool closed = first == n;
    AngularValues run;
    for (std::size_t k = 0; k < n; ++k) {
      const Entry& entry = entries[(first + k) % n];
      const double turns = first + k < n ? 0.0 : 360.0;
      if (!entry.hole) run.emplace_back(entry.degrees + turns, entry.value);
      if ((!closed && !joined_to_next((first + k) % n)) || k + 1 == n) {
        if (run.size() > 1) draw_run(run, closed, curve.stroke);
        run.clear();
      }
    }
  }

  void draw_run(const AngularValues& run, bool closed, const Stroke& stroke) const
  {
    const AngularValues smooth = angular_curve(run, closed);
    std::vector<AngularValues> parts = within(smooth, rim());
    const bool whole = parts.size() == 1 && parts.front().size() == smooth.size();
    if (whole && closed) parts.front().pop_back();  // the path closes itself
    for (const AngularValues& part : parts) {
      std::vector<Point2> points;
      for (const auto& [degrees, value] : part) points.push_back(at(degrees, value));
      if (points.size() > 1) svg_.path(points, whole && closed, stroke);
    }
  }

  Svg& svg_;
  Point2 centre_;
  double step_ = 1.0;
  int rings_ = 5;
};

double largest_value(const Curve& curve)
{
  double largest = 0.0;
  for (const auto& [degrees, value] : curve.points) largest = std::max(largest, value);
  for (const Bar& bar : curve.bars) largest = std::max(largest, bar.highest);
  return largest;
}

std::string remark(const Curve& curve, double rim)
{
  std::string out;
  const double largest = largest_value(curve);
  if (largest > rim) out += fmt::format(" (beyond the scale: up to {:.3g})", largest);
  if (!curve.endless.empty()) out += " (\u221e: no limit)";
  if (!curve.hollow.empty()) out += " (hollow: in doubt)";
  return out;
}

void draw_legend(Svg& svg, Point2 corner, const std::vector<Curve>& curves, double rim)
{
  double y = corner.y;
  for (const Curve& curve : curves) {
    if (curve.joined) svg.line({corner.x, y}, {corner.x + 44.0, y}, curve.stroke);
    if (!curve.bars.empty()) Diagram::draw_bar(svg, {corner.x + 10.0, y}, {corner.x + 34.0, y}, curve.stroke);
    Diagram::draw_marker(svg, {corner.x + 22.0, y}, curve, Diagram::outward(90.0));
    svg.text({corner.x + 54.0, y + 4.0}, curve.label + remark(curve, rim), 12);
    y += legend_line;
  }
}

}  // namespace

double scale_of(const std::vector<Curve>& curves)
{
  double before = 0.0, behind = 0.0;
  for (const Curve& curve : curves) {
    double largest = largest_value(curve);
    std::vector<double> values;
    for (const auto& [degrees, value] : curve.points)
      if (value > 0.0 && curve.joined) values.push_back(value);
    if (!values.empty() && !curve.behind && curve.bars.empty()) {
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      largest = std::min(largest, far_beyond * *middle);
    }
    double& of_all = curve.behind ? behind : before;
    of_all = std::max(of_all, largest);
  }
  return before > 0.0 && behind > far_behind * before ? before : std::max(before, behind);
}

double panel_height(std::size_t entries)
{
  return title_height + 2.0 * (radius + label_margin) + 18.0 + legend_line * static_cast<double>(entries);
}

void draw_panel(Svg& svg, Point2 corner, const Panel& panel)
{
  const Point2 centre{corner.x + panel_width / 2.0, corner.y + title_height + label_margin + radius};
  svg.text({centre.x, corner.y + 14.0}, panel.title, 14, "middle");
  if (!panel.subtitle.empty()) svg.text({centre.x, corner.y + 30.0}, panel.subtitle, 12, "middle");
  const Diagram diagram(svg, centre, scale_of(panel.curves));
  diagram.grid();
  for (const Curve& curve : panel.curves) diagram.curve(curve);
  int row = 0;
  for (const Curve& curve : panel.curves)
    if (!curve.endless.empty()) diagram.endless(curve, row++);
  diagram.ring_labels();
  draw_legend(svg, {centre.x - radius + 30.0, centre.y + radius + label_margin + 14.0}, panel.curves,
              diagram.rim());
}

}  // namespace hauberk::detail
