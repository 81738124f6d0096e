/// Sparse L D L^T: solutions and inertia against dense algebra.

#include "numerics/sparse_ldlt.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <array>
#include <random>
#include <thread>

namespace hauberk::test {
namespace {

/// A sheet of rows x columns nodes with `unknowns` each, coupled with their eight neighbours by random
/// blocks, and `whole` unknowns that are coupled with everything, as strains are. Lower triangle. With
/// `holes` some nodes are alone.
Sparse sheet(int rows, int columns, int unknowns, int whole, bool holes, std::uint64_t seed)
{
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  const int n = whole + rows * columns * unknowns;
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int first, int second, int many) {
    for (int a = 0; a < many; ++a) {
      for (int b = 0; b < unknowns; ++b) {
        if (second + b >= first + a) entries.emplace_back(second + b, first + a, normal(rng));
      }
    }
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto at = [&](int r, int c) { return whole + (r * columns + c) * unknowns; };
      couple(at(i, j), at(i, j), unknowns);
      if (holes && (i + 2 * j) % 5 == 0) continue;
      for (int k = 0; k < whole; ++k) couple(k, at(i, j), 1);
      for (const auto& [di, dj] : {std::pair{0, 1}, {1, -1}, {1, 0}, {1, 1}}) {
        const int r = i + di, c = j + dj;
        if (r < rows && c >= 0 && c < columns && !(holes && (r + 2 * c) % 5 == 0))
          couple(at(i, j), at(r, c), unknowns);
      }
    }
  }
  for (int k = 0; k < whole; ++k) entries.emplace_back(k, k, 3.0);
  Sparse lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

Eigen::MatrixXd dense(const Sparse& lower) { return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>(); }

void expect_factors(const Sparse& lower, double shift)
{
  const Eigen::MatrixXd A = dense(lower) + shift * Eigen::MatrixXd::Identity(lower.rows(), lower.rows());
  const auto n = static_cast<int>(A.rows());
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
  const auto negative = static_cast<int>((eigenvalues.array() < 0.0).count());

  SparseLdlt solver(lower, {});
  ASSERT_TRUE(solver.factor(shift, n));
  EXPECT_EQ(solver.negative(), negative);
  EXPECT_TRUE(solver.factor(shift, negative));
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, 3);
  const Eigen::MatrixXd x = solver.solve(b);
  // Backward stable where definite; without pivoting otherwise.
  const double growth = negative == 0 ? 1e-13 : 1e-9;
  EXPECT_LT((A * x - b).norm(), growth * A.norm() * x.norm());
  if (negative > 0) {
    EXPECT_FALSE(solver.factor(shift, negative - 1));
  }

  // In the order of another one: the same matrix, so the same answer.
  SparseLdlt again(lower, solver.order());
  ASSERT_TRUE(again.factor(shift, n));
  EXPECT_EQ(again.negative(), negative);
  EXPECT_LT((again.solve(b) - x).norm(), 1e-6 * x.norm());
}

TEST(SparseLdlt, CountsNegativeEigenvaluesAndSolves)
{
  for (const bool holes : {false, true}) {
    const Sparse lower = sheet(7, 9, 5, 3, holes, holes ? 2 : 1);
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(lower)).eigenvalues();
    const double middle = eigenvalues[4];
    ASSERT_LT(middle, 0.0);
    for (const double shift : {0.0, -1.3 * middle, -0.5 * (eigenvalues[2] + eigenvalues[3]),
                               -1.001 * eigenvalues[0], 10.0 - eigenvalues[0]}) {
      SCOPED_TRACE(testing::Message() << "shift " << shift << (holes ? ", holes" : ""));
      expect_factors(lower, shift);
    }
  }
}

/// Blocks wider than what is eliminated and multiplied in one piece.
TEST(SparseLdlt, FactorsFullMatrices)
{
  std::mt19937_64 rng(4);
  std::normal_distribution<double> normal;
  const int n = 230;
  Eigen::MatrixXd A(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) A(i, j) = normal(rng);
  const Sparse lower = Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
  for (const double shift : {0.0, 15.0, 60.0}) expect_factors(lower, shift);
}

TEST(SparseLdlt, RefusesZeroPivots)
{
  Sparse lower(3, 3);
  lower.insert(0, 0) = 1.0;
  lower.insert(1, 0) = 1.0;
  lower.insert(1, 1) = 1.0;  // 1 - 1^2 = 0 once the first is eliminated, or the other way round
  lower.insert(2, 2) = 1.0;
  lower.makeCompressed();
  SparseLdlt solver(lower, {});
  EXPECT_FALSE(solver.factor(0.0, 3));
  EXPECT_TRUE(solver.factor(1e-3, 3));
  EXPECT_EQ(solver.negative(), 0);
}

/// A sheet large enough for nested dissection to be tried, in threads that do so at once.
TEST(SparseLdlt, OrdersAreReproducible)
{
  const Sparse lower = sheet(60, 60, 5, 3, false, 6);
  const std::vector<int> alone = SparseLdlt(lower, {}).order();
  std::array<std::vector<int>, 4> found;
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (std::vector<int>& order : found)
    threads.emplace_back([&lower, &order] { order = SparseLdlt(lower, {}).order(); });
  for (std::thread& t : threads) t.join();
  for (const std::vector<int>& order : found) EXPECT_EQ(order, alone);
}

}  // namespace
}  // namespace hauberk::test
