#pragma once
/// Whether a limit is a maximum near its state.

#include "model.hpp"

#include <optional>

namespace hauberk::verification {

/// A state that goes further than the limit, near it.
struct Further {
  double gain = 0.0;  ///< in value, beyond what closing the limit's own gaps would gain
  double away = 0.0;  ///< largest displacement over L, turn or strain
};

/// Balanced forces make a state stationary; it is locked only when it is a maximum of the value s t . eps
/// under gaps >= 0. At a saddle of the constrained problem (a symmetric state that would buckle) everything
/// else that is checked is in order, so this looks for what a saddle is defined by: a way on.
///
/// 1. Second-order condition. With forces f and gaps g the Lagrangian s t . eps + sum f g has the Hessian
///    W = sum f d^2 g, since the load is linear. A maximum needs d . W d <= 0 for all d that keep the gaps
///    that carry force, dg . d = 0. W is taken by central differences of the gaps' gradients (normals and
///    arms at closest points found again at every difference), reduced to that null space, and its largest
///    eigenvalues decide.
/// 2. A positive one is no proof: forces may be one choice of many, a gap with little force may be in the
///    way, two closest points may merge. So the state is moved along the eigenvector, brought back to gaps >=
///    0 and on along the load by projections onto the linearised gaps (all of them, found anew), and
///    measured: only a state without intersection, whose value is further than the limit's by more than
///    closing its gaps could gain (sum f g to first order; twice that is allowed for), is an answer.
///
/// So what is found is certain, but not everything is found: with loose gaps (solver.tolerance 1e-3) weak
/// instabilities stay below the threshold.
std::optional<Further> further_nearby(const Scene& scene, const Setting& setting, const Limit& limit);

}  // namespace hauberk::verification
