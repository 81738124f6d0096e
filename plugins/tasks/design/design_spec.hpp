#pragma once
/// From the section design to what the kernel takes.

#include "design/design.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <vector>

namespace hauberk {

/// The design as the kernel takes it. The experiment must have the section.
DesignSpec design_spec(const Experiment& experiment);

/// Limits of a design: those of the targets first (in the order of `target_limits`), then those of the final
/// profile that are not among them; directions count modulo 180 degrees.
std::vector<LimitTask> design_tasks(const DesignSpec& design, const std::vector<LimitTask>& profile);

/// What of the section `solver` a design cannot be searched with (places as pointers, no lines): its search
/// takes certified steps under a constant load.
std::vector<Problem> design_solver_problems(const ExperimentSolver& solver);

}  // namespace hauberk
