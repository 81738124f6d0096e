#pragma once
/// What the parts of a design share: the scene, how its limits are computed, and what is designed.

#include "design/design.hpp"

#include <vector>

namespace hauberk {

/// The parts share it; nothing of it changes. `load` outlives it.
struct DesignScene {
  SceneSpec scene;
  const LoadCase& load;
  double clearance = 0.0;  ///< file units
  LimitSettings limits;
  DesignSpec design;
  unsigned threads = 1;
  KeepGoing keep_going;
  LimitsReport report = {};  ///< of what a search may end with; empty: it ends with what it has

  /// The scene's own values of the variables.
  std::vector<double> variables() const;
  /// Surface distance at rest that a model is relaxed to, beyond its clearance; scaled.
  double rest_target(const Model& model) const
  {
    return design.rest_clearance / model.length - model.clearance;
  }
};

}  // namespace hauberk
