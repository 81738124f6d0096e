#include "maker/lattice_step.hpp"

#include <cmath>
#include <numbers>

namespace hauberk::maker {

std::optional<LatticeStep> step_along(const std::vector<Vec3>& lattice, double degrees)
{
  constexpr int most = 8;
  constexpr double aside = 1e-6;
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vec3 n(std::cos(angle), std::sin(angle), 0.0);
  std::optional<LatticeStep> shortest;
  for (int i = -most; i <= most; ++i) {
    for (int j = -most; j <= most; ++j) {
      const Vec3 t = i * lattice[0] + j * lattice[1];
      const double along = t.dot(n);
      if (along > 0.0 && (t - along * n).norm() < aside * along && (!shortest || along < shortest->length))
        shortest = LatticeStep{{i, j}, along};
    }
  }
  return shortest;
}

}  // namespace hauberk::maker
