#pragma once
/// What pictures of an experiment's limits say in words.

#include "pictures/polar_svg.hpp"

#include <hauberk/experiment/experiment.hpp>

namespace hauberk {

PlotLabels plot_labels(const Experiment& experiment);

}  // namespace hauberk
