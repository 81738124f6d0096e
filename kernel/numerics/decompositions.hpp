#pragma once
/// Decompositions of dense matrices of any size, compiled once: each of Eigen's is a page of templates that
/// every file that uses it would compile anew. All are thread safe and take what is finite.

#include <Eigen/Core>

namespace hauberk {

/// M = V diag(values) V^T of a symmetric matrix (its lower triangle is read), eigenvalues rising.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
  bool converged;  ///< false: values and vectors mean nothing
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric);

/// The eigenvalues alone, rising.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

/// Singular values, falling.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix);

/// Orthonormal columns that span the columns of a matrix that has rows enough; dependent columns give columns
/// that are orthonormal, too (Householder's QR).
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& columns);

/// Orthonormal columns that span what is orthogonal to independent columns: as many as there are rows more
/// than columns (Householder's QR).
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& columns);

/// Orthonormal columns that span exactly the columns of a matrix: as many as its rank. Columns count as
/// dependent below `independent` times the longest (QR with pivots); 0: below what rounding leaves.
Eigen::MatrixXd orthonormal_span(const Eigen::MatrixXd& columns, double independent = 0.0);

/// Rank, by QR with pivots and the threshold of rounding.
Eigen::Index rank(const Eigen::MatrixXd& matrix);

/// x with |A x - b| least, by QR with pivots; where columns depend on each other, those left out have x = 0.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The shortest x with |A x - b| least, by a complete orthogonal decomposition.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A^+, by a complete orthogonal decomposition.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);

/// (A^T A)^-1 A^T of independent columns: the rows are the reciprocal basis.
Eigen::MatrixXd reciprocal_basis(const Eigen::MatrixXd& A);

}  // namespace hauberk
