#pragma once
/// The polar diagrams that show a run's limits against direction.

#include "pictures/polar_panel.hpp"
#include "pictures/polar_svg.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hauberk::detail {

/// Panels without curves have nothing to show.
struct ProfilePanels {
  Panel eta;     ///< (e_s - e_c)/(1 + e_c)
  Panel limits;  ///< magnitudes of both senses
};

/// Profiles of the run; of a design before and after, with its targets in the panel of its quantity.
ProfilePanels profile_panels(const RunResult& run, const PlotLabels& labels);

/// Adds values at directions in degrees (any turn, any sign) as marks that are not joined; nothing when
/// there are none.
void add_marks(Panel& panel, const std::string& label, Curve::Marker marker, const std::string& colour,
               const std::vector<std::pair<double, double>>& values);

}  // namespace hauberk::detail
