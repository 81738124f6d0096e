#pragma once
/// The benchmarks, by what they measure. Each function registers its own; `scenes` must outlive their runs.

#include "scenes.hpp"

namespace hauberk::bench {

/// Two bodies at several gaps: energies and derivatives of every formulation, separation, local minima, a
/// checked step.
void register_pairs(Scenes& scenes);

/// Contact energy of the rest state of the three published materials.
void register_energies(Scenes& scenes);

/// Whole limits: chains of 2 to 64 rings, the three materials, a bent patch.
void register_limits(Scenes& scenes);

/// One evaluation of a published design, value and gradient.
void register_designs(Scenes& scenes);

}  // namespace hauberk::bench
