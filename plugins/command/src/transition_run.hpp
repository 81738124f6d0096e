#pragma once
/// Contact of two elements along rigid motions.

#include "loading.hpp"

#include <string>

namespace hauberk::command {

/// What the section `transition` asks for, for the scene at rest.
TransitionJob transition_job(const Experiment& experiment, const SceneSpec& scene, const Schedule& schedule);

/// The jumps of every formulation along every path, as a table.
std::string transition_summary(const TransitionResult& result);

}  // namespace hauberk::command
