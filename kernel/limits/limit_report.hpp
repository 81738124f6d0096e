#pragma once
/// What is reported of one search.

#include "limits/limits.hpp"

namespace hauberk {

/// How far a state is along a task: its value, less where the sense is negative.
double reached(const Model& model, const LimitTask& task, const State& state);
/// The same of a result that has a value.
double reached(const Model& model, const LimitTask& task, const LimitResult& result);

/// The furthest sound locked state, the first of equals; null: there is none.
std::optional<std::size_t> furthest(const Model& model, const LimitTask& task, const LimitSettings& settings,
                                    const std::vector<FoundState>& found);

/// Names of a task's result.
LimitResult limit_header(const Model& model, const LimitTask& task);

/// Everything that is reported about one locked state, in file units. Where `keep_going` says no while forces
/// are computed (a second for many flat tubes): `interrupted`, and nothing of the state.
LimitResult fill_limit(const Model& model, const SceneSpec& spec, const LimitTask& task,
                       const LimitSettings& settings, const Locked& locked, const KeepGoing& keep_going);

/// What is reported of a path past the bound of strains: unbounded where links do not stop the load, not
/// attained where they let only another strain grow; failed where they say that it cannot be.
void add_witness(LimitResult& result, const Model& model, const LimitTask& task, const Locked& locked);

}  // namespace hauberk
