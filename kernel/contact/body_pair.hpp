#pragma once
/// Contact of two bodies in given poses: which of them is probed, by which formulation, and what the nearest
/// points look like.

#include "contact/formulation.hpp"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace hauberk {

/// One side of a pair (A, B): A rides in B's field, or, swapped, B in A's; its terms count `share`.
struct PairSide {
  bool swapped = false;
  double share = 1.0;
};

/// The sides that make up the energy of a pair. Of surfaces' gaps the one that second_probes() says; for an
/// arc between equals as `settings.sides` says. Else the cheaper probe set.
std::span<const PairSide> pair_sides(const Body& A, const Body& B, const ContactSettings& settings);

/// Terms of one side by the formulation of `settings`, weight `share`. `arc` and `nearest` look at `near`
/// only, which holds all gaps below g_hat.
SideTerms side_terms(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                     double share, const NearPanels& near = {});

/// Adds terms of a side, in (x_P - x_F, w_P, w_F), to terms in (x_A - x_B, w_A, w_B).
void add_side(const PairTerms& side, bool swapped, int order, PairTerms& sum);

/// Energy of a pair and its derivatives with respect to (x_A - x_B, w_A, w_B), world frame; rotations about
/// the elements' origins, Q <- exp(w) Q.
struct PairContact {
  PairTerms terms;
  double min_gap = std::numeric_limits<double>::infinity();  ///< smallest gap seen; <= 0: not admissible
  double regularity =
      std::numeric_limits<double>::infinity();  ///< see SideTerms; with derivatives to order 2
  int evaluations = 0;                          ///< closest-point evaluations
};

/// Evaluates a pair up to derivatives of order `order` (0 to 2). Scaled lengths. Thread safe.
PairContact pair_contact(const Body& A, const Pose& pose_a, const Body& B, const Pose& pose_b,
                         const ContactSettings& settings, int order);

/// A local minimum of the distance of two surfaces, and how near it is to merging with another or to
/// vanishing: both eigenvalues are 0 there, and positive elsewhere.
struct ContactMinimum {
  Vec3 on_a, on_b;        ///< nearest points, each in the frame of its own element
  double distance = 0.0;  ///< of the surfaces
  /// Smallest eigenvalue of the Hessian of the squared gap in the four chart coordinates, what equations (9)
  /// to (11) of the paper fade by; L^2. It is proportional to the gap for every contact, however regular.
  /// NaN where the published search does not converge.
  double chart_eigenvalue = 0.0;
  /// Smallest eigenvalue of the relative curvature K_A + K_B (I + distance K_B)^-1, 1/L: the second
  /// derivative of the distance along the surface. It does not depend on charts, and hardly on the gap.
  double relative_curvature = 0.0;
};

/// All local minima with a surface distance below `threshold` (certified: none is missed), nearest first;
/// those of overlapping surfaces are left out. Of tori only. Scaled lengths. Thread safe.
std::vector<ContactMinimum> contact_minima(const Body& A, const Pose& pose_a, const Body& B,
                                           const Pose& pose_b, double threshold, double clearance,
                                           int& evaluations);

}  // namespace hauberk
