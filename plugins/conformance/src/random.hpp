#pragma once
/// Draws that are the same on every machine for a seed.

#include <hauberk/linalg.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace hauberk::conformance {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Evenly in [low, high).
  double between(double low, double high)
  {
    constexpr double unit = 0x1p-53;
    return low + (high - low) * static_cast<double>(engine_() >> 11) * unit;
  }
  /// Evenly on a logarithmic scale; both ends positive.
  double scale(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  Vec3 vector(double size)
  {
    const double x = between(-size, size), y = between(-size, size);
    return {x, y, between(-size, size)};
  }
  std::vector<double> values(std::size_t count, double size)
  {
    std::vector<double> out(count);
    for (double& v : out) v = between(-size, size);
    return out;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hauberk::conformance
