#pragma once
/// What the surface and its picture are made of.

#include "design/run_result.hpp"

#include <vector>

namespace hauberk::detail {

/// A limit along components that reached a state.
struct BoundaryPoint {
  int limit = 0;  ///< index among the run's limits
  Vec3 at = Vec3::Zero();
  Vec3 direction = Vec3::Zero();
  double value = 0.0;
  LimitStatus status = LimitStatus::locked;
};

struct BoundaryPoints {
  std::vector<BoundaryPoint> points;
  std::vector<Triangle> triangles;  ///< of indices into `points`; all corners are locked
};

BoundaryPoints boundary_points(const RunResult& run);

}  // namespace hauberk::detail
