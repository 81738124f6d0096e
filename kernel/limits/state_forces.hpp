#pragma once
/// What holds the state at the end of a search, and what is reported of its forces.

#include "limits/force_balance.hpp"
#include "limits/limits.hpp"

#include <optional>

namespace hauberk {

/// Forces that miss the load by more than this part of it are said so.
inline constexpr double noticed_imbalance = 3e-5;

/// Contacts and load of a state that a search ended in; the contacts are those of the last stage. Model,
/// task, search and `keep_going` must outlive it.
struct StateForces {
  const Model& model;
  const LimitTask& task;
  const Locked& locked;
  const KeepGoing& keep_going;
  ContactEnergy contacts;
  MacroLoad load;        ///< a finite target drives the strain less the nearer it is
  double full = 0.0;     ///< norm of the full load, which imbalances are parts of
  double driving = 0.0;  ///< part of it that drives the state
  double scale = 0.0;    ///< of the value, file units
  /// By which part of the full load forces missed it before they were changed within their rounding; null:
  /// they were not.
  std::optional<double> missed_before;

  StateForces(const Model& of, const LimitTask& asked, const Locked& found, const KeepGoing& keep);

  double sign() const { return task.sense == Sense::positive ? 1.0 : -1.0; }
};

/// Largest component of the energy's gradient by which it misses the load, scaled.
double energy_imbalance(const StateForces& forces);

/// Forces of a locked state that miss the load by what rounding of gaps leaves of them are changed to such
/// that do not. Resultants of `arc` that balance no better than where they are listed are another matter:
/// there the energy's gradient tells.
void balance_forces(StateForces& forces);

/// Enters contacts, their balance, reactions of what is held and the error of quadrature, in file units;
/// `shift`: what reported poses are moved by (scaled).
void fill_forces(LimitResult& result, const StateForces& forces, const Vec3& shift);

/// Enters how the limit changes with clearance and parameters, at a kink to both sides:
/// E_min = -(+-value) + mu contact, so d value/dp = -+ mu d contact/dp (envelope theorem).
void fill_sensitivities(LimitResult& result, const StateForces& forces, const SceneSpec& spec);

}  // namespace hauberk
