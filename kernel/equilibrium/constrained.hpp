#pragma once
/// The limit as a constrained problem, without any barrier: what the barriers are compared with.

#include "equilibrium/locking.hpp"

namespace hauberk {

/// max load . macro (or the published objective) subject to gap_i(y) >= margin, for every local minimum of
/// the distance of near pairs and every wall, with the directions that the load case holds left out.
///
/// Sequential quadratic programming (Nocedal and Wright, Numerical Optimization, 2nd ed., ch. 18): in
/// unknowns scaled by the root of the metric, each step solves
///
///     min g . d + 1/2 d . B d   subject to   gap_i + A_i . d >= margin,
///
/// B the Hessian of the Lagrangian g - sum f_i gap_i by damped BFGS, and is shortened until the exact penalty
/// function value - rho sum max(0, margin - gap_i) improves on the worst of its last few values. The margin
/// is constrained_margin; forces are the multipliers, and margin times their sum is the error estimate.
///
/// Surfaces may overlap on the way, by less than half of the thinnest tube; steps are shorter than that too,
/// and keep every link. Nothing is certified. Where forces balance, a barrier as narrow as the margin tests
/// for a saddle, and leaves it; where it does not get there, `message` says so. Dense: for up to some hundred
/// unknowns. Thread safe; deterministic.
Locked constrained_lock(const Model& model, const State& start, const Vector& load, const Schedule& schedule,
                        const KeepGoing& keep_going);

}  // namespace hauberk
