#pragma once
/// Contact of a fixed and a moving element at one place of a path.

#include "contact/formulation.hpp"
#include "model/model.hpp"
#include "tasks/transition/motion.hpp"
#include "tasks/transition/transition_results.hpp"

namespace hauberk {

/// Two elements of a model, without their images, and the motion of the second. Lengths in L.
struct MovingPair {
  const Model* model = nullptr;
  int fixed = 0, moving = 1;
  RigidMotion motion;
};

/// Energy, its derivative along the path, and both for the gradient in the moving element's unknowns (x, w).
struct PathPoint {
  double s = 0.0;
  double energy = 0.0, slope = 0.0;
  Vec6 gradient = Vec6::Zero(), gradient_slope = Vec6::Zero();
  /// Smallest relative curvature of a contact, 1/L (nearest, order 2).
  double regularity = std::numeric_limits<double>::infinity();
};

/// Evaluates the pair at s, up to the energy (order 0), its gradient (1) or also the gradient's slope (2).
/// Scaled by L. Throws ComputationError where surfaces within the activation distance overlap. Thread safe.
PathPoint evaluate(const MovingPair& pair, const ContactSettings& settings, double s, int order);

/// All local minima of the distance below `range` (L), nearest first; contact numbers are not given yet.
/// Lengths as in the result: in file units.
std::vector<TransitionMinimum> minima_at(const MovingPair& pair, double range, double s);

/// Certified lower bound of the smallest gap at s, at most `enough` (L).
double gap_at(const MovingPair& pair, double s, double enough);

}  // namespace hauberk
