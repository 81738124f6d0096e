#pragma once
/// BFGS that forgets.

#include "numerics/damped_bfgs.hpp"

#include <Eigen/Core>

#include <deque>

namespace hauberk {

/// The matrix that BFGS makes of the latest steps alone. With a memory of 0 nothing is forgotten.
///
/// Old curvature misleads where the objective has kinks. The matrix is dense: what is saved by forgetting is
/// evaluations, not memory.
class LimitedMemory {
 public:
  explicit LimitedMemory(std::size_t memory) : memory_(memory) {}

  /// Forgets everything: curvature I until the first step sets the scale.
  void reset(Eigen::Index n, double curvature);
  /// Takes in the step s and the change y of the gradient along it.
  void update(const Eigen::VectorXd& s, const Eigen::VectorXd& y);

  const Eigen::MatrixXd& matrix() const { return bfgs_.matrix(); }
  bool fresh() const { return bfgs_.fresh(); }

 private:
  struct Pair {
    Eigen::VectorXd s, y;
  };

  std::size_t memory_;
  double curvature_ = 1.0;
  std::deque<Pair> pairs_;  ///< oldest first
  DampedBfgs bfgs_;
};

}  // namespace hauberk
