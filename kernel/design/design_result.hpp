#pragma once
/// What is told of a design, as written to results.json; units as in limits/limit_result.hpp.

#include "design/target.hpp"
#include "limits/limit_result.hpp"
#include "model/scene.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

struct DesignVariableResult {
  std::string name;
  double initial = 0.0, final = 0.0, lower = 0.0, upper = 0.0;
  std::vector<int> elements;  ///< those whose parameter it is, ascending
};

struct DesignTargetResult {
  double direction_deg = 0.0;
  double target = 0.0, weight = 1.0;
  Aim aim = Aim::reach;
  std::optional<double> initial, provisional, recomputed;
  bool better_state = false;
  bool met = false;  ///< `recomputed` is within `met_share` of the target
};

struct DesignIterate {
  int iteration = 0;
  double objective = 0.0, step = 0.0, optimality = 0.0, constraint_violation = 0.0;
  double min_gap = 0.0;  ///< smallest surface distance at the relaxed rest state
  bool links_kept = true;
  double seconds = 0.0;
  std::vector<double> variables;  ///< in the order of the design's
  std::vector<double> values;     ///< the designed quantity per target
  /// Limits whose locked state is not the continuation of the iterate before, e.g. "30 degrees, stretch".
  std::vector<std::string> changed;
};

struct DesignResult {
  std::string quantity, status, message;
  std::vector<DesignVariableResult> variables;
  std::vector<DesignTargetResult> targets;
  std::vector<DesignIterate> history;
  double objective_initial = 0.0, objective = 0.0;  ///< both recomputed from rest
  int iterations = 0;
  long evaluations = 0;
  double seconds = 0.0;
  int start = 0;                               ///< which perturbed start gave the design
  std::vector<std::pair<int, double>> starts;  ///< (start, final objective) of all
  SceneSpec initial_scene;                     ///< rest as used, after relaxation
  std::vector<LimitResult> initial_limits;
};

}  // namespace hauberk
