#pragma once
/// What pictures of an experiment's limits say in words.

#include <hauberk/experiment/experiment.hpp>
#include "pictures/polar_svg.hpp"

namespace hauberk {

PlotLabels plot_labels(const Experiment& experiment);

}  // namespace hauberk
