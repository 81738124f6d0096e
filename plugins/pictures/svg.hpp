#pragma once
/// A minimal writer of SVG 1.1 drawings. Coordinates in user units, y downwards, two decimals.

#include <span>
#include <string>
#include <string_view>

namespace hauberk::detail {

struct Point2 {
  double x = 0.0, y = 0.0;
};

/// How something is drawn; empty strings leave an attribute out.
struct Stroke {
  std::string colour = "#000";
  double width = 1.0;
  std::string dash;
};

class Svg {
 public:
  Svg(double width, double height);

  void line(Point2 a, Point2 b, const Stroke& stroke);
  void circle(Point2 centre, double radius, const std::string& fill, const Stroke& stroke);
  void square(Point2 centre, double half, const std::string& fill, const Stroke& stroke);
  void polygon(std::span<const Point2> points, const std::string& fill, const Stroke& stroke);
  void path(std::span<const Point2> points, bool closed, const Stroke& stroke);
  /// `anchor`: start, middle or end. With `halo`, a white rim keeps the text readable on top of lines.
  void text(Point2 at, std::string_view content, double size, const std::string& anchor = "start",
            bool bold = false, bool halo = false, const std::string& colour = "#222");

  /// The whole file.
  std::string str() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
};

}  // namespace hauberk::detail
