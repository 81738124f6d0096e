#pragma once
/// Additive continuous collision detection of meshes on rigid bodies.

#include "motion/advancement.hpp"
#include "motion/track.hpp"

namespace hauberk {

/// Largest s <= limit until which no pair of features of two meshes comes nearer than the clearance plus
/// `keep` times the smallest gap that the bodies have, or that would matter, at the start.
double advance_facets(const Body& A, const Track& ta, const Body& B, const Track& tb, double clearance,
                      double limit, double keep, SafeStep& count,
                      const std::function<bool()>* keep_going = nullptr);

}  // namespace hauberk
