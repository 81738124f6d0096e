#pragma once
/// One polar diagram: rings, spokes, curves, legend.

#include "pictures/svg.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hauberk::detail {

/// A range of values in one direction.
struct Bar {
  double degrees = 0.0, lowest = 0.0, highest = 0.0;
};

/// Values (>= 0) against direction in degrees; only finite ones.
struct Curve {
  /// `no_further` and `no_nearer` are bounds: bars across the direction with an arrowhead to what is allowed.
  enum class Marker { none, dot, square, target, cross, no_further, no_nearer };
  std::string label;
  Stroke stroke;
  Marker marker = Marker::none;
  bool joined = true;
  std::vector<std::pair<double, double>> points;
  /// Directions that were asked for but have no value: the curve is interrupted there.
  std::vector<double> holes;
  /// Those of the holes where there is no limit at all: marked at the rim.
  std::vector<double> endless;
  std::vector<double> hollow;  ///< directions whose markers are hollow: values that are in doubt
  std::vector<Bar> bars;       ///< drawn along their directions, with ends across them
  bool behind = false;         ///< shown for comparison: may leave the scale that the others need
};

/// The largest value of a panel's scale: of every curve that is not behind, but at most ten times its median;
/// of marks that are not joined; and of what is behind, unless that is more than two and a half times these.
/// 0 where there is no value.
double scale_of(const std::vector<Curve>& curves);

struct Panel {
  std::string title;
  std::string subtitle;  ///< below the title, smaller; may be empty
  std::vector<Curve> curves;
};

inline constexpr double panel_width = 430.0;
/// Height of a panel with `entries` lines of legend.
double panel_height(std::size_t entries);

void draw_panel(Svg& svg, Point2 corner, const Panel& panel);

}  // namespace hauberk::detail
