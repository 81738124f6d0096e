#pragma once
/// What an optimizer knows about a point.

#include <Eigen/Core>

#include <algorithm>
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
  Eigen::VectorXd gradient;     ///< n
  Eigen::VectorXd c;            ///< m constraint values, feasible where >= 0, and the equations where 0
  Eigen::MatrixXd J;            ///< m x n
  Eigen::Index equalities = 0;  ///< the first ones are equations
};

/// Residuals and their Jacobian at one point, in scaled variables.
struct Residuals {
  Eigen::VectorXd r;  ///< empty: the problem has none
  Eigen::MatrixXd J;

  bool empty() const { return r.size() == 0; }
};

/// By how much each constraint is violated: |c_i| of the first `equalities`, max(0, -c_i) of the others.
inline Eigen::VectorXd violations(const Eigen::VectorXd& c, Eigen::Index equalities)
{
  Eigen::VectorXd out = (-c).cwiseMax(0.0);
  out.head(equalities) = c.head(equalities).cwiseAbs();
  return out;
}
inline double total_violation(const Eigen::VectorXd& c, Eigen::Index equalities)
{
  return violations(c, equalities).sum();
}
inline double total_violation(const Linearisation& at) { return total_violation(at.c, at.equalities); }
/// 0 without constraints; not-a-number counts as none.
inline double largest_violation(const Eigen::VectorXd& c, Eigen::Index equalities)
{
  double largest = 0.0;
  for (const double violation : violations(c, equalities)) largest = std::max(largest, violation);
  return largest;
}
inline double largest_violation(const Linearisation& at) { return largest_violation(at.c, at.equalities); }

}  // namespace hauberk
