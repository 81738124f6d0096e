#include "numerics/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace hauberk {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SymmetricEigen symmetric_eigen(const MatrixXd& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Eigen::Success};
}

VectorXd symmetric_eigenvalues(const MatrixXd& symmetric)
{
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd singular_values(const MatrixXd& matrix)
{
  return Eigen::JacobiSVD<MatrixXd>(matrix).singularValues();
}

MatrixXd orthonormal_columns(const MatrixXd& columns)
{
  return Eigen::HouseholderQR<MatrixXd>(columns).householderQ() *
         MatrixXd::Identity(columns.rows(), columns.cols());
}

MatrixXd orthogonal_complement(const MatrixXd& columns)
{
  const Eigen::HouseholderQR<MatrixXd> qr(columns);
  const MatrixXd Q = qr.householderQ();
  return Q.rightCols(columns.rows() - columns.cols());
}

MatrixXd orthonormal_span(const MatrixXd& columns, double independent)
{
  Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  if (independent > 0.0) qr.setThreshold(independent);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

Eigen::Index rank(const MatrixXd& matrix) { return Eigen::ColPivHouseholderQR<MatrixXd>(matrix).rank(); }

VectorXd least_squares(const MatrixXd& A, const VectorXd& b)
{
  return Eigen::ColPivHouseholderQR<MatrixXd>(A).solve(b);
}

VectorXd shortest_least_squares(const MatrixXd& A, const VectorXd& b)
{
  return A.completeOrthogonalDecomposition().solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& A) { return A.completeOrthogonalDecomposition().pseudoInverse(); }

MatrixXd reciprocal_basis(const MatrixXd& A) { return (A.transpose() * A).inverse() * A.transpose(); }

}  // namespace hauberk
