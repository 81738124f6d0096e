#pragma once
/// The quadratic model of a constrained problem at an iterate, and the step it proposes.

#include "point.hpp"

#include <Eigen/Core>

namespace hauberk {

struct Step {
  bool ok = false;
  bool elastic = false;          ///< the linearised constraints had no common point and were relaxed
  Eigen::VectorXd d;             ///< n
  Eigen::VectorXd multipliers;   ///< m, >= 0 but those of equations
  double model_violation = 0.0;  ///< total violation of c + J d
  Eigen::VectorXd gradient;      ///< n, of the objective at the iterate; at kinks, the mean that the step saw
  double decrease = 0.0;         ///< of the objective, as the model promises
  double descent = 0.0;  ///< a step alpha d decreases the objective by at least alpha descent, to first order
};

/// min g.d + 1/2 d.B d subject to c + J d >= 0, of equations = 0, and lower <= d <= upper, where lower <= 0
/// <= upper.
///
/// Where the constraints have no common point, those that are violated at d = 0 get a slack each (equations
/// on the side on which they are) whose sum is charged with an exact penalty, raised from `penalty` until a
/// dearer slack would not get smaller; the result then reduces the violation as far as the model allows.
Step propose_step(const Eigen::MatrixXd& B, const Linearisation& at, const Eigen::VectorXd& lower,
                  const Eigen::VectorXd& upper, double penalty);

}  // namespace hauberk
