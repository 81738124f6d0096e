#pragma once
/// How a lattice repeats itself along a direction.

#include <hauberk/linalg.hpp>

#include <array>
#include <optional>
#include <vector>

namespace hauberk::maker {

/// A lattice vector: so many of the first vector and of the second, and its length.
struct LatticeStep {
  std::array<int, 2> counts{};
  double length = 0.0;
};

/// The shortest of few combinations of the vectors of a sheet that lies along a direction, in degrees from x.
std::optional<LatticeStep> step_along(const std::vector<Vec3>& lattice, double degrees);

}  // namespace hauberk::maker
