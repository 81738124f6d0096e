#pragma once
/// Witnesses: motions from rest past the bound of strains, which show that nothing stops a load.
#include "checks.hpp"
#include "kinematics.hpp"

#include <cstddef>
#include <vector>

namespace hauberk::verification {

/// Whether the motion from one state to another is free of intersection: macroscopic unknowns and u change
/// linearly (kinematics.hpp), elements turn about fixed axes in space.
///
/// Over an interval of time of half-length h no point of a pair comes nearer than
/// h (|dF (X_i - X_j - T) + du_i - du_j| + |w_i| reach_i + |w_j| reach_j), which is exact for the origins;
/// where the separation half-way is larger the interval is free, otherwise it is halved. Images too far to be
/// listed are covered by |dF F^-1|. Periodic loads only.
enum class Motion { free, meets, undecided };
Motion motion(const Scene& scene, const MovedState& from, const MovedState& to);

/// Everything about the witness of an unbounded or not attained limit; what was found is said in `found`.
/// States that end a piece of the motion which the bound leaves undecided go to `undecided`: that piece was
/// only looked at in places.
void check_witness(const Scene& scene, const Limit& limit, Sentences& problems, Sentences& found,
                   std::vector<std::size_t>& undecided);

}  // namespace hauberk::verification
