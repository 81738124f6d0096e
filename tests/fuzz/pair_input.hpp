#pragma once
/// Bytes as a pair of tori and a motion: all zeros are two equal coaxial circles, small numbers are symmetric
/// and touching arrangements, large ones anything.

#include <torus.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace hauberk::fuzz {

/// Two tori, in lengths from 1e-6 to 1e6.
struct PairInput {
  brute::Torus a, b;
  double clearance = 0.0;  ///< in L and in a.R: small against both
  Pose frame;              ///< a rigid motion that must not matter, in L
  bool dear = false;       ///< list minima also where that takes seconds
  bool turned = false;     ///< also list the minima of the moved pair
  bool published = false;  ///< also try the published check of steps, which takes a hundred times as long
  std::array<double, 15> step{};  ///< strain, then translation and turn of both: unknowns of a model in L
};

PairInput decode(const std::uint8_t* data, std::size_t size);

/// For messages.
std::string describe(const PairInput& input);

}  // namespace hauberk::fuzz
