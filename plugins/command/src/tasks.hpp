#pragma once
/// From an experiment to what the kernel computes.

#include <hauberk/design/design.hpp>
#include <hauberk/experiment/experiment.hpp>

#include <vector>

namespace hauberk::command {

/// Angles x senses of the load case, angle by angle; then directions along components.
std::vector<LimitTask> profile_tasks(const Experiment& experiment);

/// The design as the kernel takes it. The experiment must have the section.
DesignSpec design_spec(const Experiment& experiment);

/// Limits of a design: those of the targets first (in the order of `target_tasks`), then those of the final
/// profile that are not among them; directions count modulo 180 degrees.
std::vector<LimitTask> design_tasks(const DesignSpec& design, const std::vector<LimitTask>& profile);

}  // namespace hauberk::command
