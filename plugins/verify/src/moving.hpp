#pragma once
/// Gaps with their gradients in moved states, for the check of second order; unknowns as in kinematics.hpp.
#include "kinematics.hpp"

namespace hauberk::verification {

/// A gap less the clearance over L, and its derivative by the unknowns.
struct GapRow {
  double gap = 0.0;
  Vector gradient;
};

/// Of a listed contact, whose closest points are found again in `state`.
GapRow row_of(const Scene& scene, const Setting& setting, const MovedState& state, const Contact& contact);

/// Of every local minimum of every pair within `range` (L), and of the walls.
std::vector<GapRow> all_rows(const Scene& scene, const Setting& setting, const MovedState& state,
                             double range);

}  // namespace hauberk::verification
