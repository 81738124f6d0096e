#pragma once
/// Minimisation of E(y) = -load . macro + mu contact(y), or of the published objective, at fixed stiffness,
/// without passing through anything.

#include "equilibrium/stage.hpp"

#include <functional>
#include <string>
#include <vector>

namespace hauberk {

enum class StageStatus {
  minimum,
  stalled,
  iteration_limit,
  unbounded,
  not_a_sheet,
  merging,
  spent,
  interrupted
};

/// Outcome of a stage.
struct StageResult {
  StageStatus status = StageStatus::stalled;
  std::string message;
  int iterations = 0;
  long evaluations = 0;
  double energy = 0.0;
  double residual = 0.0;    ///< norm of dE/dy over the norm of the load, in the dual of the step norm
  int escapes = 0;          ///< saddles left along a direction of negative curvature
  std::vector<State> path;  ///< where kept: the states after each step; steps between them are checked
};

/// Called between iterations; returns false to interrupt. Must be thread safe.
using KeepGoing = std::function<bool()>;

/// Trust-region Newton from `state` (gaps positive) to a minimum of E.
///
/// Every trial step is first shortened by the stage's collision check: by conservative advancement, so that
/// the path from the first to the last state is free of intersections, or by the sampled one; F stays
/// positive definite. The quadratic model is shifted by lambda * metric until it is positive definite and its
/// step stays within the trust radius. A stationary point with negative curvature is left along it. Null
/// directions (spins, rattlers, translations) carry a tiny shift and cost nothing. A state that is no sheet
/// any more (LoadCase::not_a_sheet) ends it. Throws ComputationError where no shift makes the curvature
/// definite, which it does not come to while numbers are finite. Thread safe; deterministic. `bounds`: what
/// is known of gaps from stages before; otherwise nothing is at the beginning.
StageResult solve_stage(const Model& model, State& state, const Vector& load, const Stage& stage,
                        const KeepGoing& keep_going, GapBounds* bounds = nullptr);

}  // namespace hauberk
