#pragma once
/// Gradients of quantities of an equilibrium with respect to element parameters.

#include "equilibrium/stage.hpp"

#include <optional>

namespace hauberk {

/// d Q / d parameters, and how well Q is determined.
struct AdjointGradient {
  Matrix parameters;  ///< column k = element k, file units, as ContactEnergy::parameters
  /// |H a - dQ/dy| / |dQ/dy| in the dual of the step norm: near 0 unless Q depends on directions in which the
  /// state is free (spins, rattlers), or on some so soft that rounding hides their stiffness.
  double residual = 0.0;
  long evaluations = 0;
};

/// Total derivative of Q(y) along the minima y(p) of E(y, p) at fixed stiffness.
///
/// At a minimum f(y, p) = -dE/dy = 0, and it stays so: df/dy dy/dp + df/dp = 0 (the paper's adjoint). With
/// H = d2E/dy2 and H a = dQ/dy
///
///     dQ/dp = -a . d2E/(dy dp),
///
/// and the right-hand side is the derivative of the explicit dE/dp(y + s a, p) in s: differences of fourth
/// order along the single direction a, with steps far below the smallest gap, serve all parameters at once.
/// Directions in which H vanishes up to rounding are left out.
///
/// The explicit derivative of E needs none of this (envelope theorem), and is what a design uses for value
/// minus contact energy. What is differentiated here is any other quantity; `quantity` = dQ/dy has the size
/// of the unknowns, with the load in its first entries for the value itself. `state` must be a minimum of the
/// stage. Throws ComputationError where it touches. Thread safe; deterministic.
AdjointGradient adjoint_gradient(const Model& model, const State& state, const Vector& load,
                                 const Stage& stage, const Vector& quantity);

/// dy/dt of the minimum y(t) of a stage while a model becomes another at t = 1, at the beginning: with g =
/// dE/dy, H dy/dt = -dg/dt, where dg/dt is a difference between the model and `ahead`, which is `share` of
/// the way.
///
/// Directions softer than a thousandth of the load (L = 1) are damped: there the straight line says little of
/// where the minimum goes. `ahead` should change no surface by more than some thousandths of the smallest
/// gap. Null where one of the two states touches, or the curvature is more negative than that. Counts closest
/// points in `evaluations`. Thread safe; deterministic.
std::optional<Vector> response_of_minimum(const Model& model, const Model& ahead, double share,
                                          const State& state, const Vector& load, const Stage& stage,
                                          long& evaluations);

}  // namespace hauberk
