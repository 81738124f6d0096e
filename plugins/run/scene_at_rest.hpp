#pragma once
/// The scene of an experiment at the rest state that limits begin from.

#include "limits/limits.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <string>
#include <vector>

namespace hauberk {

struct SceneAtRest {
  SceneSpec scene;         ///< relaxed where elements touched
  double moved = 0.0;      ///< farthest that relaxation moved an element, file units
  Model model;             ///< of `scene`, under the experiment's load case, which has to outlive it
  LimitSettings settings;  ///< of `scene`; `start` where limits do not start at rest (PreparedScene)
};

/// What is wrong with the rest state goes to `problems`, and the scene is then of no use. Throws InputError
/// where there is no room, ComputationError where no rest state can be computed. Thread safe.
SceneAtRest scene_at_rest(const Experiment& experiment, std::vector<std::string>& problems);

}  // namespace hauberk
