#pragma once
/// The longest period of a chain of two rings by search over poses, with brute-force distances.

#include "minima.hpp"

namespace hauberk::brute {

/// Largest x of ring B's centre (x, y, 0) at which B, with the given axes, is linked with A (centre at the
/// origin) and does not overlap it; 0 where there is none.
double largest_offset(Torus A, Torus B, double y);

/// Longest period of ... A B A' B' ... in a straight line, all centres at z = 0: maximises the offset from A
/// to B plus that from B to the next A over both rings' axes and B's sideways offset, by Nelder-Mead,
/// restarted with smaller simplices, from `starts` starting poses. Spins about the rings' own axes change
/// nothing.
double longest_period(const Torus& A, const Torus& B, int starts);

}  // namespace hauberk::brute
