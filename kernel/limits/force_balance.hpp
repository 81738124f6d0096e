#pragma once
/// How the forces of listed contacts balance a load.

#include "equilibrium/contact_energy.hpp"
#include "model/held_model.hpp"

#include <optional>
#include <vector>

namespace hauberk {

/// Rounding of coordinates, L: a barrier's force at a gap g is as exact as g, which this is a part of.
inline constexpr double rounding_of_x = 1e-15;

/// load + sum of forces times gap derivatives = held * reactions.
struct ForceBalance {
  Vector reactions;        ///< of the conditions held: by how much the load's value rises per unit of each
  double imbalance = 0.0;  ///< largest component of what is left, over all unknowns
};
/// `mu` times the points' forces, of a state with that load.
ForceBalance force_balance(const Model& model, const State& state, const MacroLoad& load,
                           const std::vector<ContactEnergy::Point>& points, double mu);

/// The part of forces on all unknowns that neither the model's equalities nor conditions take up.
Vector unheld(const Model& model, const Matrix& held, const Vector& forces);

/// A barrier's force is as exact as its gap: it is off by some multiple of 1e-15 L over the gap, the rounding
/// of coordinates. Where elements wedge each other forces are many times the load, and what rounding leaves
/// of them is a part of the load that tells. The part by which each force is to be changed so that all
/// balance: the least change, where each counts in units of its own rounding (forces at smaller gaps change
/// more). Forces that are not negative, at closed gaps, and balance the load prove a limit, whatever barrier
/// they came from. Null: some force would have to change by more than rounding explains, or by a tenth; a
/// point has no gap; or there are too many unknowns for dense matrices (Model::sparse).
std::optional<Vector> balancing_parts(const Model& model, const State& state, const MacroLoad& load,
                                      const std::vector<ContactEnergy::Point>& points, double mu);

/// Changes the contacts' forces by these parts. Those of `nearest`, which are of single gaps, take the
/// energy's derivatives in clearance and parameters along; false, and nothing is changed, where a point is at
/// no gap of the state. Gradient and Hessian stay those of the energy.
bool change_forces(ContactEnergy& contacts, const Model& model, const State& state, Formulation formulation,
                   const Vector& parts);

}  // namespace hauberk
