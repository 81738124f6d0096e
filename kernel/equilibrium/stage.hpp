#pragma once
/// A stage of a path of barriers: the energy that it minimises, and which steps it checks.

#include "equilibrium/contact_energy.hpp"
#include "model/near_pairs.hpp"
#include "motion/advancement.hpp"

#include <limits>
#include <vector>

namespace hauberk {

/// One stage: contact formulation, activation distance and stiffness (scaled).
struct Stage {
  ContactSettings contact;
  double mu = 0.0;  ///< E has the unit of the value
  CollisionCheck ccd = CollisionCheck::certified;
  /// T of the published objective (paper equations (12) and (14)), 1/2 |macro - T load|^2: divided by T and
  /// without its constant, -load . macro + |macro|^2/(2 T). Infinite: the load alone.
  double target = std::numeric_limits<double>::infinity();
  /// Draws macroscopic unknowns to where tether^T macro = 0: adds tether_stiffness / 2 |tether^T macro|^2.
  Matrix tether;
  double tether_stiffness = 0.0;
  /// Ends as `merging` at a state with a contact less curved than this (relative curvature, 1/L; nearest).
  double least_curvature = -std::numeric_limits<double>::infinity();
  bool balance = false;     ///< last stage: go on where forces do not balance though the energy is flat
  double tolerance = 1e-3;  ///< stop when the Newton step can lower E by less than tolerance * mu
  /// Stop also where a step that no radius shortens can lower E by less than this times mu, and does not, nor
  /// changes it by more: what is left is the noise of a rough quadrature.
  double tolerance_of_noise = 0.0;
  bool keep_path = false;     ///< StageResult::path is wanted
  int most_iterations = 200;  ///< in which the energy does not fall by mu; 50 times as many in all
  /// Ends as `spent` after the step with which there are more (StageResult::evaluations).
  long most_evaluations = std::numeric_limits<long>::max();
};

/// Norm of a load in the dual of the step norm.
double load_size(const Model& model, const Vector& load);

/// What drives the macroscopic unknowns in a state: the load, less macro/T where the target is finite, less
/// what a tether pulls. At an equilibrium the contact forces balance it.
Vector driving_load(const Model& model, const State& state, const Vector& load, const Stage& stage);

/// -load . macro (+ |macro|^2/(2 T), + a tether's energy) + mu contact, with derivatives as asked.
struct TotalEnergy {
  double energy = 0.0;
  Vector gradient;
  Matrix hessian;  ///< with what the load case holds made stiff
  /// Lower triangle, of models with many unknowns (Model::sparse), with nothing held.
  Eigen::SparseMatrix<double> sparse_hessian;
  ContactEnergy contact;
  bool admissible = false;  ///< all gaps positive
};
TotalEnergy total_energy(const Model& model, const State& state, const Vector& load, const Stage& stage,
                         const std::vector<ElementPair>& pairs, int order, const GapBounds* bounds = nullptr);

/// How far the step is free of collisions by the stage's check; `keep`: the part of any gap that the
/// certified one leaves.
SafeStep checked_step(const Model& model, const State& from, const Vector& dy, double keep,
                      const Stage& stage, GapBounds* bounds = nullptr);

/// Element pairs that can matter within this stage's range, in this state.
std::vector<ElementPair> stage_pairs(const Model& model, const State& state, const Stage& stage);

}  // namespace hauberk
