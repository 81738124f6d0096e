#pragma once
/// Random pairs of tori, most of them special: the cases where distance routines go wrong.

#include "minima.hpp"

#include <random>
#include <string>

namespace hauberk::brute {

/// How the two tori lie.
enum class Family {
  anywhere,        ///< random distance and turn
  coplanar,        ///< axes parallel, exactly or nearly, centres in one plane
  coaxial,         ///< one axis, exactly or nearly
  nearly_tangent,  ///< pushed together until 1e-2 .. 1e-9 apart
  tightly_linked,  ///< linked, pushed until 1e-2 .. 1e-9 apart
  through_center,  ///< one core circle passes through the centre of the other
  symmetric,       ///< axes perpendicular or parallel, centres along a common axis
  thin             ///< tubes of 1 to 5 % of the ring, linked or close
};
inline constexpr int family_count = 8;
std::string name(Family family);

struct TorusPair {
  Torus a, b;
  Family family = Family::anywhere;
};

/// Pair number k: deterministic, independent of how many are drawn. Round/round, round/elliptical and
/// elliptical/elliptical take turns, as do the families; R_a = 1, R_b/R_a in 0.1 .. 10, r0/R in 0.02 .. 0.6,
/// r1/r0 in 0.2 .. 5. Overlapping draws are repeated up to 30 times, then kept.
TorusPair random_pair(long k);

/// Uniformly distributed rotation.
Mat3 any_rotation(std::mt19937_64& rng);
/// Uniformly distributed unit vector.
Vec3 any_direction(std::mt19937_64& rng);

/// Turns both about one axis and shifts them: away from the axes of the world.
void move_together(Torus& a, Torus& b, std::mt19937_64& rng);

}  // namespace hauberk::brute
