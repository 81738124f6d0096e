/// Matrices without rows or columns: elements without coordinates of their own, loads without conditions.

#include "numerics/decompositions.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Decompositions, OfMatricesWithoutColumns)
{
  const MatrixXd none(3, 0);
  const VectorXd b = VectorXd::Ones(3);
  EXPECT_EQ(least_squares(none, b).size(), 0);
  EXPECT_EQ(shortest_least_squares(none, b).size(), 0);
  EXPECT_EQ(rank(none), 0);
  EXPECT_EQ(singular_values(none).size(), 0);
  EXPECT_EQ(orthonormal_span(none).cols(), 0);
  EXPECT_EQ(orthonormal_span(none, 1e-6).rows(), 3);
  EXPECT_EQ(orthonormal_columns(none).cols(), 0);
  const MatrixXd all = orthogonal_complement(none);
  ASSERT_EQ(all.cols(), 3);
  EXPECT_TRUE((all.transpose() * all).isIdentity(1e-15));
  const MatrixXd inverse = pseudo_inverse(none);
  EXPECT_EQ(inverse.rows(), 0);
  EXPECT_EQ(inverse.cols(), 3);
  EXPECT_TRUE(symmetric_eigen(MatrixXd(0, 0)).converged);
  EXPECT_EQ(symmetric_eigenvalues(MatrixXd(0, 0)).size(), 0);
}

TEST(Decompositions, OfMatricesWithoutRows)
{
  const MatrixXd none(0, 2);
  EXPECT_EQ(least_squares(none, VectorXd()), VectorXd::Zero(2));
  EXPECT_EQ(shortest_least_squares(none, VectorXd()), VectorXd::Zero(2));
  EXPECT_EQ(rank(none), 0);
  EXPECT_EQ(pseudo_inverse(none).rows(), 2);
}

TEST(Decompositions, LeastSquaresAndInverses)
{
  MatrixXd A(3, 2);
  A << 1, 2, 3, 4, 5, 7;
  const VectorXd x = VectorXd::LinSpaced(2, 1.0, -2.0);
  EXPECT_TRUE(least_squares(A, A * x).isApprox(x, 1e-13));
  EXPECT_TRUE(shortest_least_squares(A, A * x).isApprox(x, 1e-13));
  EXPECT_TRUE((pseudo_inverse(A) * A).isIdentity(1e-13));
  EXPECT_EQ(rank(A), 2);
  EXPECT_LT((A.transpose() * orthogonal_complement(A)).norm(), 1e-13);
}

}  // namespace
}  // namespace hauberk::test
