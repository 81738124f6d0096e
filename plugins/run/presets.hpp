#pragma once
/// What the names of presets mean, in one place.

#include "limits/limits.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// What of the section `solver` cannot be used with this experiment (places as pointers, no lines).
std::vector<Problem> solver_problems(const Experiment& experiment);

/// True if there are triangle meshes and the contact is not that of meshes, without which there is no model.
bool meshes_without_contact(const Experiment& experiment);

/// Settings of limits: the preset, then what the file says beyond it (tolerance, max_stages, max_iterations,
/// contact, searches, target, starts, perturbation, start_seed). Preset paper has absolute lengths, so the
/// unit of the scene's file counts.
LimitSettings limit_settings(const ExperimentSolver& solver, const SceneSpec& scene, const std::string& unit);

/// Stages used while designing: few, since the bias that they leave is reported by recomputing all limits.
Schedule design_schedule();

}  // namespace hauberk
