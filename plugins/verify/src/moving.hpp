#pragma once
/// States moved by unknowns y, and gaps with their gradients, for the check of second order. Unknowns,
/// without unit: exx, eyy, exy, then for each element a displacement u over L and a turn exp(w) about its
/// origin.
#include "model.hpp"

#include <vector>

namespace hauberk::verification {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

struct MovedState {
  Strain macro;
  std::vector<Place> places;
};

Eigen::Index unknowns(const Scene& scene);

/// x = F X + u moves with F; z stays where the setting fixes it.
MovedState moved(const Scene& scene, const Setting& setting, const MovedState& state, const Vector& y);

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
