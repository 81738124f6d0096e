#pragma once
/// What is asked of the limit in one direction, and how far a value misses it.

#include <optional>
#include <string>

namespace hauberk {

/// What a target asks of a value. Further is away from zero: a compression of -0.2 is further than one of
/// -0.1.
enum class Aim {
  reach,       ///< to be equal to the target
  no_further,  ///< to end at the target or nearer
  no_nearer    ///< to end at the target or further
};

/// "reach", "no_further", "no_nearer", as in files.
std::string to_string(Aim aim);
/// The aim of this name; null: there is none.
std::optional<Aim> aim_named(const std::string& name);

/// The residual of a value: value - target (in the value's unit), and zero where the bound of an aim is kept.
/// Its square has a continuous gradient: value's, times `miss`.
double miss(Aim aim, double target, double value);

/// The part of |target| within which a target counts as met: 5 % of a value to reach, a thousandth of a
/// bound, since what may not be exceeded may not be exceeded by 5 % either.
double met_share(Aim aim);

/// Whether `value` misses `target` by no more than `share` of it.
bool is_within(double share, Aim aim, double target, double value);

}  // namespace hauberk
