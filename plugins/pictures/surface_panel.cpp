#include "pictures/surface_panel.hpp"

#include "pictures/line_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk::detail {
namespace {

constexpr double margin = 34.0;       ///< around the drawing, for numbers
constexpr double least_area = 0.02;   ///< of a face, in units of the drawing
constexpr int most_ticks = 4;         ///< on a half axis
constexpr double least_shown = 0.15;  ///< an axis seen from nearer to its end than this has no numbers

class Panel {
 public:
  Panel(Svg& svg, Point2 corner, double size, const View& view, double reach)
      : svg_(svg),
        centre_{corner.x + 0.5 * size, corner.y + 0.5 * size},
        scale_((0.5 * size - margin) / reach),
        reach_(reach),
        view_(view)
  {
  }

  void faces(const BoundaryPoints& surface) const
  {
    struct Face {
      std::array<Point2, 3> corners;
      double depth = 0.0, light = 0.0;
    };
    std::vector<Face> list;
    list.reserve(surface.triangles.size());
    // From the upper left, so that slopes to all sides differ.
    const Vec3 lamp = (0.8 * view_.toward + 0.5 * view_.up - 0.3 * view_.right).normalized();
    for (const Triangle& t : surface.triangles) {
      const Vec3 &a = point(surface, t[0]), &b = point(surface, t[1]), &c = point(surface, t[2]);
      const Vec3 normal = (b - a).cross(c - a);
      // Corners that share a state, and faces seen edge-on, leave nothing to fill.
      if (!(0.5 * scale_ * scale_ * std::abs(view_.toward.dot(normal)) > least_area)) continue;
      const double light = std::max(0.0, normal.normalized().dot(lamp));
      list.push_back({{at(a), at(b), at(c)}, view_.toward.dot(a + b + c) / 3.0, light});
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const Face& a, const Face& b) { return a.depth < b.depth; });
    for (const Face& f : list) svg_.polygon(f.corners, grey(f.light), {"#33475b", 0.4, ""});
  }

  void points(const BoundaryPoints& surface, bool stems) const
  {
    for (const BoundaryPoint& p : surface.points) {
      const bool locked = p.status == LimitStatus::locked;
      if (stems) svg_.line(at(Vec3::Zero()), at(p.at), {"#999", 0.7, ""});
      if (stems || !locked) svg_.circle(at(p.at), 2.6, locked ? "#111" : "#fff", {"#111", 1.0, ""});
    }
  }

  /// Over the surface, dashed: most of an axis lies inside.
  void axis(const Vec3& direction, const std::string& name) const
  {
    const Point2 end = at(reach_ * direction), start = at(-reach_ * direction);
    const double shown = std::hypot(view_.right.dot(direction), view_.up.dot(direction));
    if (shown < least_shown) return;
    svg_.line(start, end, {"#111", 0.9, "2,3"});
    const Point2 beyond = at((reach_ + 17.0 / (scale_ * shown)) * direction);
    svg_.text({beyond.x, beyond.y + 4.0}, name, 12, "middle", true, true);
    const double step = tick_step(reach_, most_ticks);
    const Point2 side{(end.y - start.y) / std::hypot(end.x - start.x, end.y - start.y),
                      (start.x - end.x) / std::hypot(end.x - start.x, end.y - start.y)};
    const double down = side.y < 0.0 ? -1.0 : 1.0;
    const int ticks = static_cast<int>(std::floor(reach_ / step + 1e-9));
    for (int k = -ticks; k <= ticks; ++k) {
      if (k == 0) continue;
      const Point2 p = at(k * step * direction);
      svg_.line({p.x - 3.0 * side.x, p.y - 3.0 * side.y}, {p.x + 3.0 * side.x, p.y + 3.0 * side.y},
                {"#111", 0.9, ""});
      svg_.text({p.x + 13.0 * down * side.x, p.y + 13.0 * down * side.y + 3.0},
                fmt::format("{:.4g}", k * step), 9, "middle", false, true);
    }
  }

 private:
  static const Vec3& point(const BoundaryPoints& surface, int k) { return surface.points[k].at; }

  Point2 at(const Vec3& x) const
  {
    return {centre_.x + scale_ * view_.right.dot(x), centre_.y - scale_ * view_.up.dot(x)};
  }

  static std::string grey(double light)
  {
    const double level = 0.42 + 0.56 * light;
    const auto channel = [level](double tint) {
      return static_cast<int>(std::lround(255.0 * std::min(1.0, level * tint)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", channel(0.94), channel(0.98), channel(1.04));
  }

  Svg& svg_;
  Point2 centre_;
  double scale_, reach_;
  const View& view_;
};

}  // namespace

View plane_view(int across, int upward, const std::array<std::string, 3>& names)
{
  View out;
  out.title = fmt::format("{} and {}", names[across], names[upward]);
  out.right = Vec3::Unit(across);
  out.up = Vec3::Unit(upward);
  out.toward = out.right.cross(out.up);
  return out;
}

View oblique_view()
{
  // Turned by 35 degrees from the first axis, 25 degrees above the plane of the first two.
  const double turn = 35.0 * std::numbers::pi / 180.0, rise = 25.0 * std::numbers::pi / 180.0;
  View out;
  out.title = "oblique";
  out.toward = {std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise)};
  out.right = Vec3::UnitZ().cross(out.toward).normalized();
  out.up = out.toward.cross(out.right);
  return out;
}

void draw_surface(Svg& svg, Point2 corner, double size, const View& view, const BoundaryPoints& surface,
                  double reach, const std::array<std::string, 3>& names)
{
  const Panel panel(svg, corner, size, view, reach);
  svg.text({corner.x + 14.0, corner.y + 12.0}, view.title, 12);
  panel.faces(surface);
  for (int k = 0; k < 3; ++k) panel.axis(Vec3::Unit(k), names[k]);
  panel.points(surface, surface.triangles.empty());
}

}  // namespace hauberk::detail
