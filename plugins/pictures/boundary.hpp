#pragma once
/// The boundary of what a fabric can reach: as a surface for other programs, and as a picture.

#include "design/run_result.hpp"
#include "pictures/polar_svg.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// ASCII PLY 1.0 of the limits along components that reached a state, in the order of `run.limits`:
///
///     vertex: x y z (the macroscopic unknowns at the limit), value, status (LimitStatus as a number: 0
///     locked,
///             1 unbounded, 2 not attained, 3 stalled, 4 failed, 5 interrupted), dx dy dz (its direction),
///             limit (its index in results.json)
///     face:   triangles of `run.boundary` with three locked corners, counter-clockwise from outside
///
/// Numbers read back as the same doubles. `unit` and `macro_names` go to comments. Same results, same bytes.
std::string boundary_ply(const RunResult& run, const std::string& unit,
                         const std::vector<std::string>& macro_names);

/// The same limits in an oblique view and along the three axes, as an SVG file that needs nothing else and
/// stays readable in black and white: triangles shaded by their slope, the rest state at the origin, numbers
/// on the axes. Limits of a list, which have no triangles, are dots joined to the origin.
std::string boundary_svg(const RunResult& run, const PlotLabels& labels,
                         const std::vector<std::string>& macro_names);

}  // namespace hauberk
