#pragma once
/// Orthogonal parts that a symmetry of a scene can have.

#include "model/model.hpp"

#include <vector>

namespace hauberk {

/// The lattice's point group: all O that map the lattice of the cell to itself. With two lattice vectors O
/// maps their plane to itself. The identity first, in a fixed order. Not for scenes without lattice vectors.
std::vector<Mat3> lattice_point_group(const Model& model);

/// For patches: all O that keep the z axis (up to its sign) and carry an element that is the rarest of its
/// kind
/// (`kinds`, by element) at its distance from the axis to such an element. The identity first, in a fixed
/// order.
std::vector<Mat3> patch_candidates(const Model& model, const std::vector<int>& kinds);

}  // namespace hauberk
