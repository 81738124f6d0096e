#pragma once
/// Which locked states are one state of the fabric: those in which the same forces hold the same strain.

#include <hauberk/limits/symmetry.hpp>
#include <hauberk/mechanics/contact_energy.hpp>

#include <span>
#include <vector>

namespace hauberk {

/// What carries the load in a locked state: the macroscopic unknowns and, per pair of elements in contact,
/// the resultant of its contacts. Where elements lie that carry nothing (rattlers), and how elements are
/// turned without a contact noticing (a ring about its axis), is no part of it.
struct ForceNetwork {
  struct Pair {
    int i = 0, j = 0;  ///< i of the cell, j of `image`; i <= j. A wall that i touches: j = -1
    Image image{};
    Vec3 force = Vec3::Zero();  ///< on j, or on the wall; 1/length, scaled
  };
  Vector macro;
  std::vector<Pair> pairs;  ///< every pair once, ordered by (i, j, image)
};

/// The network of a state from its contacts, whose forces times mu (the stiffness of their energy) are
/// forces.
ForceNetwork force_network(const Model& model, const State& state,
                           std::span<const ContactEnergy::Point> contacts, double mu);

/// The network that a symmetry makes of one; null where the macroscopic unknowns do not transform.
std::optional<ForceNetwork> transformed(const Model& model, const SceneSymmetry& g,
                                        const ForceNetwork& network);

/// Elements that no force above `part` of the largest one acts on.
std::vector<int> rattlers(const Model& model, const ForceNetwork& network, double part = 1e-6);

/// When two networks are one.
struct SameFabric {
  double macro = 1e-5;  ///< difference of the macroscopic unknowns in the load case's metric (scaled)
  double force = 1e-2;  ///< difference of a pair's resultants, by the largest one
};

/// Whether one of the symmetries makes of network `a` a network with the macroscopic unknowns and the forces
/// of `b`, up to the tolerances; a pair that only one of them has counts as one without force in the other.
/// With all symmetries of a scene (scene_symmetries) mirror images and translated copies count as one state.
///
/// States that are the same by this have the same value and the same load path. States that differ only in
/// the places of rattlers are the same. Where contacts are more than the unknowns that they hold, forces are
/// not unique, and one state with two sets of forces counts as two: never too few are counted.
bool same_fabric_state(const Model& model, std::span<const SceneSymmetry> symmetries, const ForceNetwork& a,
                       const ForceNetwork& b, const SameFabric& tolerance = {});

}  // namespace hauberk
