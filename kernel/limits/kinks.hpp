#pragma once
/// One-sided sensitivities where contact forces are not unique.

#include "limits/limits.hpp"

namespace hauberk {

/// Derivatives of the value, scaled, towards smaller and larger clearance or parameter. Infinite where the
/// locked state has no room at all that way.
struct OneSidedSensitivities {
  std::array<double, 2> clearance{};              ///< per scaled length
  std::vector<std::array<double, 2>> parameters;  ///< of all elements in turn, per unit of the file
};

/// At a locked state with gaps g_k = 0 the value's derivative in a parameter p follows from linear
/// programming duality: with the multipliers f of
///
///     F = {f >= 0 : t + sum_k f_k dg_k/dy = 0}
///
/// the value max t . y moves by min over F of sum f_k dg_k/dp when p grows, and by the maximum when p falls
/// (Gauvin 1979; for a value that is minimised the two change places). Where F is one point both are the
/// sensitivity; else the limit has a kink there.
///
/// Active are contacts and walls with gaps below a hundred times the last activation distance. Null: forces
/// are unique, or nothing is known: the formulation has no contacts at points, a finite target drives the
/// state, more than 250 unknowns, or no multipliers balance the load to 1e-4 of it (line contacts). Thread
/// safe.
std::optional<OneSidedSensitivities> one_sided_sensitivities(const Model& model, const LimitTask& task,
                                                             const Locked& locked);

}  // namespace hauberk
