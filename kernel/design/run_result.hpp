#pragma once
/// Limits and a design of one scene together: what files, pictures and reports are made from.

#include "design/design_result.hpp"
#include "limits/limit_result.hpp"
#include "model/scene.hpp"

#include <optional>
#include <vector>

namespace hauberk {

/// Everything a run produces except the resolved experiment and provenance.
struct RunResult {
  SceneSpec scene;  ///< rest as used, after relaxation; the final design's
  std::vector<LimitResult> limits;
  std::vector<ProfilePoint> profiles;
  std::optional<DesignResult> design;
  std::optional<BoundarySurface> boundary;  ///< when there are limits along components
};

}  // namespace hauberk
