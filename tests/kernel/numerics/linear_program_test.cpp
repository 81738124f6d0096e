/// Linear programs against an enumeration of all vertices.

#include "numerics/linear_program.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The least value over all vertices of {f >= 0, A f = b}, A of full row rank; null: there are none.
std::optional<double> over_vertices(const MatrixXd& A, const VectorXd& b, const VectorXd& c)
{
  std::optional<double> least;
  const Index n = A.cols(), m = A.rows();
  for (unsigned set = 0; set < (1U << n); ++set) {
    std::vector<Index> basis;
    for (Index i = 0; i < n; ++i) {
      if (set >> i & 1U) basis.push_back(i);
    }
    if (static_cast<Index>(basis.size()) != m) continue;
    const Eigen::FullPivLU<MatrixXd> lu(A(Eigen::all, basis));
    if (!lu.isInvertible()) continue;
    const VectorXd f = lu.solve(b);
    if (f.minCoeff() < -1e-9) continue;
    const double value = c(basis).dot(f);
    if (!least || value < *least) least = value;
  }
  return least;
}

TEST(LinearProgram, FindsTheLeastVertex)
{
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal;
  int feasible = 0, infeasible = 0;
  for (int k = 0; k < 300; ++k) {
    const Index m = 1 + k % 4, n = m + 1 + k % 5;
    MatrixXd A = MatrixXd::NullaryExpr(m, n, [&] { return normal(rng); });
    A.row(0) = A.row(0).cwiseAbs();  // bounds the polyhedron
    VectorXd b = VectorXd::NullaryExpr(m, [&] { return normal(rng); });
    b[0] = std::abs(b[0]);
    LinearProgram program(A, b);
    const VectorXd c = VectorXd::NullaryExpr(n, [&] { return normal(rng); });
    const std::optional<double> expected = over_vertices(A, b, c);
    EXPECT_EQ(program.feasible(), expected.has_value()) << k;
    if (!expected) {
      ++infeasible;
      EXPECT_FALSE(program.least(c));
      continue;
    }
    ++feasible;
    for (int again = 0; again < 2; ++again) {  // from where the last one ended, too
      ASSERT_TRUE(program.least(c)) << k;
      EXPECT_NEAR(*program.least(c), *expected, 1e-8) << k;
      EXPECT_NEAR(*program.least(-c), *over_vertices(A, b, -c), 1e-8) << k;
    }
  }
  EXPECT_GT(feasible, 100);
  EXPECT_GT(infeasible, 20);
}

/// f_1 + f_2 = 1, f_1 - f_3 = 0 and both once more: dependent rows and degenerate vertices.
TEST(LinearProgram, TakesDependentRowsAndDegenerateVertices)
{
  MatrixXd A(4, 4);
  A << 1, 1, 0, 0, 1, 0, -1, 0, 2, 1, -1, 0, 0, 0, 0, 1;
  VectorXd b(4);
  b << 1, 0, 1, 0;
  LinearProgram program(A, b);
  ASSERT_TRUE(program.feasible());
  EXPECT_NEAR(*program.least(Eigen::Vector4d(1, 0, 0, 5)), 0.0, 1e-15);
  EXPECT_NEAR(*program.least(Eigen::Vector4d(-1, 0, -1, 5)), -2.0, 1e-15);
}

TEST(LinearProgram, SaysWhatHasNoBound)
{
  LinearProgram program(Eigen::RowVector2d(1, -1), VectorXd::Constant(1, 1.0));
  EXPECT_NEAR(*program.least(Eigen::Vector2d(1, 0)), 1.0, 1e-15);
  EXPECT_EQ(*program.least(Eigen::Vector2d(-1, 0)), -std::numeric_limits<double>::infinity());
  LinearProgram none(Eigen::RowVector2d(1, 1), VectorXd::Constant(1, -1.0));
  EXPECT_FALSE(none.feasible());
  EXPECT_FALSE(none.least(Eigen::Vector2d(1, 0)));
}

}  // namespace
}  // namespace hauberk
