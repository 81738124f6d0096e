#pragma once
/// The stages of a barrier on the way to a locked state, with nothing held but what the model holds.

#include "equilibrium/locking.hpp"

namespace hauberk {

/// Whether there are tubes that ribbons (Sides::ribbon) are of.
bool has_flat_tubes(const Model& model);

/// A planned stage of a schedule for a load of this size.
Stage barrier_stage(const Model& model, double load_size, ContactChoice choice, const Schedule& schedule,
                    const PlannedStage& plan);

/// `lock` by barriers, with nothing held.
Locked barrier_lock(const Model& model, const State& start, const Vector& load, ContactChoice choice,
                    const Schedule& schedule, const KeepGoing& keep_going);

}  // namespace hauberk
