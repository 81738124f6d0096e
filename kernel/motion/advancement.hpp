#pragma once
/// How far along a step nothing collides: certified by conservative advancement, or sampled as published.

#include "motion/gap_bounds.hpp"

#include <functional>

namespace hauberk {

/// How steps are checked for collisions.
enum class CollisionCheck { certified, sampled };

/// What the check found.
struct SafeStep {
  double alpha = 1.0;  ///< nothing collides for s in [0, alpha]
  long evaluations = 0;
  int tight_pairs = 0;  ///< pairs that needed more than the first look
};

/// Part of every gap that a step of a search leaves, and a straight way of a witness.
inline constexpr double keep_gap = 0.1;

/// A certified alpha, nearly the largest: for every pair of bodies the gap stays above `keep` times the one
/// at the start. Gaps are surface distances minus clearance.
///
/// Over s in [s0, s0 + tau] the field at a probe point is bounded below by its value and first derivatives
/// at (u_mid, s0), and by second derivatives of known size:
///   phi >= phi_mid - |phi_u| h + min(0, phi_s) tau
///          - 1/2 ((|p_u| h + V tau)^2/rho_min + |p_uu| h^2 + a tau^2 + 2 W |p_u| h tau),
/// V: bound of the relative speed of material points, a: of their relative acceleration in F's frame, W: of
/// the relative angular speed. Panels are halved where the bound fails because of h, tau where it fails
/// because of tau. As tangential sliding enters only through V^2 tau^2, sliding at a small gap costs
/// V/sqrt(g rho) steps, not V/g. Ends at 2e6 evaluations of one pair.
///
/// Bodies with facets are checked as meshes, by additive advancement of every pair of features (Li, Kaufman,
/// Jiang 2021) with bounds of their speeds over rigid motions. Thread safe, deterministic; `threads` share
/// the pairs of a large scene and never change a result.
///
/// `bounds`, if given, says which pairs, and which panels of others, are too far apart to be looked at, and
/// is left with what was found of all panels. Of pairs with room to spare half of the gap is certified, if it
/// can be. How far the step goes may depend on it; that it is safe does not.
///
/// `keep_going`, if given, is asked now and then within a pair; where it says no, Interrupted is thrown.
SafeStep largest_safe_step(const Model& model, const State& from, const Vector& dy, double keep,
                           unsigned threads = 1, GapBounds* bounds = nullptr,
                           const std::function<bool()>* keep_going = nullptr);

/// The published check (paper equations (6) to (8)), without guarantee. For every pair of bodies the smallest
/// distance over s in [0, alpha] is sought by minimisation in s from sampled closest points; where it is not
/// above `least_gap` (beyond the clearance), alpha falls by a factor 0.9. Steps are shortened beforehand so
/// that no pair moves by more than its smallest tube radius. Thread safe, deterministic.
SafeStep sampled_safe_step(const Model& model, const State& from, const Vector& dy, double least_gap);

}  // namespace hauberk
