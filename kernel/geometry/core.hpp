#pragma once
/// Cores: closed curves at the middle of tubes, whatever a tube's kind.

#include "geometry/body.hpp"
#include "geometry/closed_curve.hpp"

#include <numbers>

namespace hauberk {

/// Whether a body is a tube of constant radius r0 around its core: a circle, a curve, or the probe of a solid
/// of dimension 1, which may be a segment that is run through there and back.
bool is_round(const Body& body);

/// The period of a core's parameter u.
inline constexpr double full_turn = 2.0 * std::numbers::pi;

/// A point of the core in the body's frame: of a circle tube and of an ellipse revolved the circle of radius
/// R, of a curve tube its curve, of a solid its probe, which has one dimension.
CurvePoint core_at(const Body& body, const Angle& u);

/// Upper bounds of the lengths of its first two derivatives.
struct CoreBounds {
  double first, second;
};
CoreBounds core_bounds(const Body& body);

/// How often the core turns, at most: the number of its harmonics, or of a solid what its derivatives say.
int core_degree(const Body& body);

}  // namespace hauberk
