#pragma once
/// Whether the end of a search is an answer.

#include "limits/state_forces.hpp"

#include <string>

namespace hauberk {

/// What an answer is, and what is said about it.
struct Verdict {
  LimitStatus status;
  std::string message;
};

/// What the search itself says.
Verdict end_of_search(const Model& model, const Locked& locked);

/// What a state is taken for by all that is known of it; `result` has its value, gap, links and forces.
Verdict verdict_of(const LimitResult& result, const StateForces& forces, const LimitSettings& settings);

}  // namespace hauberk
