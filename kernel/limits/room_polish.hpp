#pragma once
/// The last digits of a state with most room.

#include "equilibrium/relaxation.hpp"
#include "limits/limits.hpp"

namespace hauberk {

/// From a state near a local maximum of its smallest gap, which is `smallest` there, to that maximum, links
/// kept:
///
///     max over (y, t) of t  subject to  g_k(y) >= t for all gaps k,
///
/// by sequential quadratic programming, with damped BFGS for the Hessian of sum f_k g_k (f_k >= 0 the
/// multipliers, which add up to 1) and steps that are shortened until the smallest gap grows. Maxima are flat
/// along some motions, where asking for larger gaps ends short of them. The smallest gap never falls. Of
/// models that are stored sparse, and where nothing is near, the state is returned as it is.
State polished_room(const Model& model, const State& state, double smallest, Cell cell,
                    const KeepGoing& keep_going);

}  // namespace hauberk
