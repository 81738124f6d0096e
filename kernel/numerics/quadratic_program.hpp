#pragma once
/// Small dense, strictly convex quadratic programs.

#include <Eigen/Core>

namespace hauberk {

/// min 1/2 x^T G x + a^T x subject to A x >= b, with G symmetric positive definite.
struct QuadraticProgram {
  Eigen::MatrixXd G;  ///< n x n
  Eigen::VectorXd a;  ///< n
  Eigen::MatrixXd A;  ///< m x n, one row a constraint; m may be 0
  Eigen::VectorXd b;  ///< m
};

struct QuadraticSolution {
  enum class Status {
    solved,
    infeasible,  ///< no x satisfies the constraints
    failed       ///< G is not positive definite, something is not finite, or rounding prevented progress
  };
  Status status = Status::failed;
  Eigen::VectorXd x;            ///< n, meaningful when solved
  Eigen::VectorXd multipliers;  ///< m, >= 0: G x + a = A^T multipliers; zero for inactive constraints
};

/// Solves by the dual active-set method: Goldfarb and Idnani, Mathematical Programming 27 (1983) 1-33.
/// Constraints may be linearly dependent and degenerate. Thread safe.
QuadraticSolution solve(const QuadraticProgram& program);

}  // namespace hauberk
