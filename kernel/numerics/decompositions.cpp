#include "numerics/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace hauberk {

// Where Eigen looks for the largest entry of a matrix that has none, it reads beyond the end.

using Eigen::MatrixXd;
using Eigen::VectorXd;

SymmetricEigen symmetric_eigen(const MatrixXd& symmetric)
{
  if (symmetric.size() == 0) return {VectorXd(), MatrixXd(), true};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Eigen::Success};
}

VectorXd symmetric_eigenvalues(const MatrixXd& symmetric)
{
  if (symmetric.size() == 0) return {};
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd singular_values(const MatrixXd& matrix)
{
  if (matrix.size() == 0) return {};
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
  if (columns.size() == 0) return MatrixXd(columns.rows(), 0);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  if (independent > 0.0) qr.setThreshold(independent);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

Eigen::Index rank(const MatrixXd& matrix)
{
  return matrix.size() == 0 ? 0 : Eigen::ColPivHouseholderQR<MatrixXd>(matrix).rank();
}

VectorXd least_squares(const MatrixXd& A, const VectorXd& b)
{
  if (A.size() == 0) return VectorXd::Zero(A.cols());
  return Eigen::ColPivHouseholderQR<MatrixXd>(A).solve(b);
}

VectorXd shortest_least_squares(const MatrixXd& A, const VectorXd& b)
{
  if (A.size() == 0) return VectorXd::Zero(A.cols());
  return A.completeOrthogonalDecomposition().solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& A)
{
  if (A.size() == 0) return MatrixXd::Zero(A.cols(), A.rows());
  return A.completeOrthogonalDecomposition().pseudoInverse();
}

MatrixXd reciprocal_basis(const MatrixXd& A) { return (A.transpose() * A).inverse() * A.transpose(); }

}  // namespace hauberk
