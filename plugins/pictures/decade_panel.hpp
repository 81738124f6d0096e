#pragma once
/// A diagram with two logarithmic axes: lines through marked points.

#include "pictures/svg.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::detail {

/// Both coordinates positive.
struct DecadePoint {
  double x = 1.0, y = 1.0;
  bool ringed = false;  ///< stands out by a heavy ring
};

/// Points joined in their order.
struct DecadeLine {
  std::string label;
  Stroke stroke;
  std::size_t marker = 0;  ///< see draw_marker
  std::vector<DecadePoint> points;
};

struct DecadePanel {
  std::string title, x_label, y_label;
  std::vector<DecadeLine> lines;
  std::optional<double> floor;  ///< a level across, positive
  std::string floor_label;
};

/// The size of a plot, without labels.
struct DecadeFrame {
  double width = 400.0, height = 300.0;
};

/// Whole decades that hold everything, a line and a number at each; at least one.
void draw_decade_panel(Svg& svg, Point2 corner, const DecadeFrame& frame, const DecadePanel& panel);

/// A small figure in the colour of `stroke`: circle, square, triangle, diamond, turned triangle, cross, plus
/// and bar, filled, then the same hollow.
void draw_marker(Svg& svg, Point2 centre, std::size_t marker, const Stroke& stroke);

/// A sample of the line with its marker and label, from `corner` on.
void draw_decade_legend(Svg& svg, Point2 corner, const DecadeLine& line);

}  // namespace hauberk::detail
