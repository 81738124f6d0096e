#pragma once
/// Local minima of the distance of two tori, for checks that move a state.
#include "model.hpp"

#include <vector>

namespace hauberk::verification {

/// Where two surfaces are closest, locally.
struct Touching {
  double distance = 0.0;       ///< of the surfaces, signed
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
};

/// The local minimum that descent reaches from the point of a nearest to `near`.
Touching touching_near(const Primitive& a, const Primitive& b, const Vec3& near);

/// All local minima with a distance below `range` that a dense sampling of one surface shows.
std::vector<Touching> touchings(const Primitive& a, const Primitive& b, double range);

}  // namespace hauberk::verification
