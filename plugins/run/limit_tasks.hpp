#pragma once
/// The limits that a load case names.

#include "limits/limits.hpp"
#include "limits/plan.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// Angles x senses of the load case, angle by angle; then directions along components.
std::vector<LimitTask> profile_tasks(const Experiment& experiment);

/// "19 elements, 4 limits", and how many of them links do not hold.
std::string limits_check_line(const Plan& plan, std::size_t limits);

}  // namespace hauberk
