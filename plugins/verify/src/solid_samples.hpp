#pragma once
/// Whether what a plugin says of a solid agrees with itself.
#include "model.hpp"

#include <string>

namespace hauberk::verification {

/// Compares a solid's chart, distance and probe on samples; what disagrees, and by how much, in words, or
/// nothing. Tolerances are over the solid's radius.
///
/// - Points of the chart are at distance 0, and within the radius of the origin.
/// - A tenth of the thickness (or reach) beyond one along the normal the distance is that tenth.
/// - No point of the chart is nearer to a point outside than `at_least` says.
/// - A probe with one coordinate is the core of the surface: points of the chart are `offset` from its
/// nearest
///   point, and points `offset` from the core across it are at distance 0. One with two coordinates is at
///   distance 0.
std::string disagreement(const Solid& solid, double tolerance);

}  // namespace hauberk::verification
