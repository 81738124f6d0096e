#pragma once
/// What the names of presets mean, in one place.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/limits/limits.hpp>

#include <string>

namespace hauberk::command {

/// Why a preset cannot be used, empty when it can.
std::string preset_problem(const std::string& preset);

/// Settings of limits: the preset, then what the file says beyond it (tolerance, max_stages, max_iterations,
/// contact, starts, perturbation, start_seed).
LimitSettings limit_settings(const ExperimentSolver& solver);

/// Stages used while designing: few, since the bias that they leave is reported by recomputing all limits.
Schedule design_schedule();

}  // namespace hauberk::command
