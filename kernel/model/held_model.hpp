#pragma once
/// The model that is left when a limit holds conditions on the macroscopic unknowns.

#include "model/model.hpp"

#include <memory>

namespace hauberk {

/// What drives a search to a locked state: the load on the macroscopic unknowns, and the conditions on them
/// that the locked state keeps, held^T macro = 0.
struct MacroLoad {
  Vector pull;
  Matrix held;  ///< macro_count x conditions, linearly independent columns; no columns: nothing is held

  MacroLoad() = default;
  /// A load with nothing held.
  MacroLoad(Vector load) : pull(std::move(load)), held(pull.size(), 0) {}
  MacroLoad(Vector load, Matrix conditions) : pull(std::move(load)), held(std::move(conditions)) {}
};

/// The load of an angle or of components in a sense, with what the load case holds there. Throws PluginError
/// when the load case's conditions depend on each other or leave the load nothing to move.
MacroLoad macro_load(const Model& model, const Direction& direction, Sense sense);

/// The part of a macroscopic step or of a load that conditions leave: the nearest one in the Euclidean norm.
Vector within(const Matrix& held, const Vector& macro);

/// Largest condition that a macroscopic state misses, over the size of that condition's coefficients.
double missed(const Matrix& held, const Vector& macro);

/// Whether a macroscopic state keeps conditions, up to what a symmetry that carried it over or a file's
/// digits are off by (1e-9, strain or curvature times L).
bool keeps(const Matrix& held, const Vector& macro);

/// A model restricted to macroscopic states macro = B q that keep the conditions.
///
/// B spans the null space of held^T. Its columns are orthonormal in the load case's norm, so that sums of |q|
/// bound strains as those of macro do. Poses, gaps, contacts and element unknowns are those of the full
/// model; only the macroscopic unknowns are fewer, and every solver works on them as it does on any load
/// case's. The full model must outlive it. Immutable, thread safe.
class HeldModel {
 public:
  HeldModel(const Model& full, const Matrix& held);

  const Model& model() const { return model_; }
  /// q of a state that keeps the conditions (of its nearest part that does).
  State restricted(const State& full) const;
  State full(const State& restricted) const;
  /// The load on q: B^T pull.
  Vector pull(const Vector& full) const { return basis_.transpose() * full; }

 private:
  Matrix basis_, back_;  ///< macro = basis_ q; q = back_ macro
  std::unique_ptr<const LoadCase> load_;
  Model model_;
};

}  // namespace hauberk
