#pragma once
/// A diagram of lines over a common axis.

#include "pictures/svg.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hauberk::detail {

/// Points joined in their order; a gap where a value is missing.
struct Line {
  std::string label;
  Stroke stroke;
  std::vector<std::pair<double, std::optional<double>>> points;
};

/// A horizontal mark with a word to it.
struct Level {
  double value = 0.0;
  std::string label;
};

struct LinePanel {
  std::string title;
  std::vector<Line> lines;
  std::vector<Level> levels;  ///< shown where they lie within what the lines take up, or just beyond
  bool from_zero = true;      ///< the axis starts at zero when no value is negative
  /// Values of both signs and many orders of magnitude: linear below 1, decades beyond (asinh).
  bool decades = false;
};

/// What all panels of a column share.
struct LineFrame {
  double x_from = 0.0, x_to = 1.0;
  double width = 400.0, height = 130.0;  ///< of the plot, without labels
};

/// Draws the panel with the left upper corner of its plot at `corner`; numbers stand to the left of it, the
/// title above; those of the x axis below it if `numbered`.
void draw_line_panel(Svg& svg, Point2 corner, const LineFrame& frame, const LinePanel& panel, bool numbered);

/// 1, 2 or 5 times a power of ten, so that `span` > 0 has at most `most` of it.
double tick_step(double span, int most);

/// A legend in one row from `corner` on; returns where it ends.
double draw_line_legend(Svg& svg, Point2 corner, const std::vector<Line>& lines);

}  // namespace hauberk::detail
