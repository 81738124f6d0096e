#pragma once
/// The polar plot of a deformation-limit profile.

#include "design/run_result.hpp"

#include <string>

namespace hauberk {

/// What the plot says in words.
struct PlotLabels {
  std::string title;                 ///< of the whole drawing, usually the experiment's name
  std::string subtitle;              ///< e.g. measure and clearance; may be empty
  std::string positive = "stretch";  ///< name of the positive sense
  std::string negative = "compression";
  std::string unit = "strain";                     ///< of limits: "strain", or "1/mm" for curvatures
  std::string before = "before", after = "after";  ///< a design's two states
};

/// Draws the limits against direction, 0 to 360 degrees (directions count modulo 180), as an SVG file that
/// needs no fonts or other files and stays readable in black and white. One panel for eta, one for the
/// magnitudes of both senses; each only when there is something to show. For a design: before, after, and
/// targets as dots, bounds as bars with an arrowhead. Directions more than 45 degrees apart are not joined by
/// a line, nor are points without a value. Thread safe; the same results give the same bytes.
std::string polar_svg(const RunResult& run, const PlotLabels& labels);

}  // namespace hauberk
