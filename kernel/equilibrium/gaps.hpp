#pragma once
/// Gaps of close pairs with their derivatives.

#include "equilibrium/contact_energy.hpp"

#include <string>

namespace hauberk {

/// A local minimum of the distance between two bodies.
struct Gap {
  int a = 0, b = 0;  ///< bodies; b in image
  Image image{};
  double gap = 0.0;  ///< surface distance minus clearance, scaled; negative when they overlap
  Vector dy;         ///< derivative in all unknowns
  Vector da, db;  ///< derivative in the parameters of a's and b's element (file units, scaled gap per unit)
};

/// All local minima closer than `range` (scaled, after clearance), in a fixed order; derivatives on request.
/// `evaluations` grows by the closest-point evaluations that it took (of surfaces; meshes count none).
std::vector<Gap> find_gaps(const Model& model, const State& state, double range, bool derivatives,
                           long* evaluations = nullptr);

/// Smallest gap over all pairs within `range`, infinity if none.
double smallest_gap(const Model& model, const State& state, double range);

/// True if facets of two bodies meet: gaps of meshes are distances, and do not tell on which side of each
/// other they are.
bool meshes_meet(const Model& model, const State& state);

/// "element 3 (side_1 of threefold)": the number as in the results, names as in the experiment.
std::string body_name(const SceneSpec& spec, const Body& body);

/// "element 3 (side_1 of threefold) and element 0 (ring of link) of image [1, 0]": numbers as in the results,
/// names as in the experiment.
std::string pair_name(const SceneSpec& spec, const Model& model, const Gap& gap);

/// "; the tightest are ...", for messages; empty where no pair is closer than one L.
std::string tightest_pair(const SceneSpec& spec, const Model& model, const State& state);

}  // namespace hauberk
