#pragma once
/// Quasi-Newton approximation of the Hessian of the Lagrangian.

#include <Eigen/Core>

namespace hauberk {

/// BFGS with Powell's damping (Nocedal and Wright, Numerical Optimization, 2nd ed., procedure 18.2), kept
/// positive definite: eigenvalues that rounding or curvature pushed below a floor are shifted to it.
class DampedBfgs {
 public:
  /// B = curvature I. The first update then sets the scale anew.
  void reset(Eigen::Index n, double curvature);

  /// Takes in the step s and the change y of the Lagrangian's gradient along it. Does nothing for s = 0 or
  /// values that are not finite.
  void update(const Eigen::VectorXd& s, const Eigen::VectorXd& y);

  /// Symmetric positive definite.
  const Eigen::MatrixXd& matrix() const { return B_; }
  /// True since the last reset until the first update.
  bool fresh() const { return fresh_; }

 private:
  Eigen::MatrixXd B_;
  bool fresh_ = true;
};

}  // namespace hauberk
