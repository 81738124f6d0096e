#pragma once
/// The distinct locked states that searches of one limit end in.

#include "limits/limits.hpp"

#include <vector>

namespace hauberk {

/// Largest less smallest change of the elements' heights from rest, scaled.
double z_range(const Model& model, const State& state);

/// Adds a search's state to the list of distinct locked states; mirror images count once, and the furthest of
/// equals stands for all.
void add_start(std::vector<LockedState>& list, const Model& model, const LimitTask& task,
               const FoundState& found);
/// Lets the state that is reported stand for those that are one with it.
void stand_for_equals(std::vector<LockedState>& list, const Model& model, const LimitTask& task,
                      const FoundState& reported);

}  // namespace hauberk
