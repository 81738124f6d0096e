#pragma once
/// What an optimizer knows about a point.

#include <Eigen/Core>

#include <string>

namespace hauberk {

/// Objective and gradient at one point; `ok` is false when either could not be had.
struct Trial {
  bool ok = false;
  double value = 0.0;
  Eigen::VectorXd gradient;  ///< with respect to scaled variables
  std::string why;
};

/// First-order information at an iterate, in scaled variables.
struct Linearisation {
  Eigen::VectorXd gradient;  ///< n
  Eigen::VectorXd c;         ///< m constraint values, feasible where >= 0
  Eigen::MatrixXd J;         ///< m x n
};

/// Residuals and their Jacobian at one point, in scaled variables.
struct Residuals {
  Eigen::VectorXd r;  ///< empty: the problem has none
  Eigen::MatrixXd J;

  bool empty() const { return r.size() == 0; }
};

/// sum_i max(0, -c_i).
inline double total_violation(const Eigen::VectorXd& c) { return (-c).cwiseMax(0.0).sum(); }
/// max(0, -min c).
inline double largest_violation(const Eigen::VectorXd& c)
{
  return c.size() == 0 || !(c.minCoeff() < 0.0) ? 0.0 : -c.minCoeff();
}

}  // namespace hauberk
