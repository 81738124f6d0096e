#pragma once
/// Small dense, strictly convex quadratic programs.

#include <Eigen/Core>

namespace hauberk {

/// min 1/2 x^T G x + a^T x subject to A x = b in the first `equalities` rows and A x >= b in the others, with
/// G symmetric positive definite.
struct QuadraticProgram {
  Eigen::MatrixXd G;  ///< n x n
  Eigen::VectorXd a;  ///< n
  Eigen::MatrixXd A;  ///< m x n, one row a constraint; m may be 0
  Eigen::VectorXd b;  ///< m
  Eigen::Index equalities = 0;
};

struct QuadraticSolution {
  enum class Status {
    solved,
    infeasible,  ///< no x satisfies the constraints
    failed       ///< G is not positive definite, something is not finite, or rounding prevented progress
  };
  Status status = Status::failed;
  Eigen::VectorXd x;  ///< n, meaningful when solved
  /// m: G x + a = A^T multipliers; of inequalities >= 0, and zero where they are inactive.
  Eigen::VectorXd multipliers;
};

/// Solves by the dual active-set method: Goldfarb and Idnani, Mathematical Programming 27 (1983) 1-33.
/// Equations are made active first and stay so. Constraints may be linearly dependent and degenerate: of
/// dependent equations that agree, one multiplier is zero. Thread safe.
QuadraticSolution solve(const QuadraticProgram& program);

}  // namespace hauberk
