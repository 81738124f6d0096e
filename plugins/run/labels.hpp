#pragma once
/// What pictures of an experiment's limits say in words.

#include "pictures/polar_svg.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <span>
#include <string>

namespace hauberk {

/// `varied`: pointers to values of the experiment that the picture's rows replace, which are not told of all.
PlotLabels plot_labels(const Experiment& experiment, std::span<const std::string> varied = {});

}  // namespace hauberk
