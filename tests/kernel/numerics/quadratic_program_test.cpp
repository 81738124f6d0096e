#include "numerics/quadratic_program.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Status = QuadraticSolution::Status;

/// The minimum by enumerating active sets: solve the KKT equations of each and take the one that satisfies
/// all conditions. Null when there is none.
std::optional<VectorXd> enumerate(const QuadraticProgram& q)
{
  const Index n = q.G.rows();
  const Index m = q.A.rows();
  for (unsigned set = 0; set < (1U << m); ++set) {
    std::vector<Index> active;
    for (Index i = 0; i < m; ++i) {
      if (set >> i & 1U) active.push_back(i);
    }
    const auto k = static_cast<Index>(active.size());
    if (k > n || (set & ((1U << q.equalities) - 1U)) != (1U << q.equalities) - 1U) continue;
    MatrixXd K = MatrixXd::Zero(n + k, n + k);
    VectorXd rhs(n + k);
    K.topLeftCorner(n, n) = q.G;
    rhs.head(n) = -q.a;
    if (k > 0) {
      const MatrixXd N = q.A(active, Eigen::all);
      K.topRightCorner(n, k) = -N.transpose();
      K.bottomLeftCorner(k, n) = N;
      rhs.tail(k) = q.b(active);
    }
    const Eigen::FullPivLU<MatrixXd> lu(K);
    if (!lu.isInvertible()) continue;
    const VectorXd y = lu.solve(rhs);
    const double tolerance = 1e-11 * (1.0 + y.norm());
    const Index unequal = k - q.equalities;
    if (unequal > 0 && y.tail(unequal).minCoeff() < -tolerance) continue;
    const VectorXd slack = q.A * y.head(n) - q.b;
    if (m > q.equalities && slack.tail(m - q.equalities).minCoeff() < -tolerance) continue;
    return VectorXd(y.head(n));
  }
  return std::nullopt;
}

void expect_kkt(const QuadraticProgram& q, const QuadraticSolution& s, double tolerance)
{
  const VectorXd residual = q.G * s.x + q.a - q.A.transpose() * s.multipliers;
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), tolerance);
  for (Index i = 0; i < q.b.size(); ++i) {
    const double slack = q.A.row(i).dot(s.x) - q.b[i];
    EXPECT_GT(slack, -tolerance);
    if (i < q.equalities) {
      EXPECT_LT(slack, tolerance);
      continue;
    }
    EXPECT_GE(s.multipliers[i], 0.0);
    if (s.multipliers[i] > 0.0) {
      EXPECT_LT(slack, tolerance);
    }
  }
}

QuadraticProgram random_program(std::mt19937& random, Index n, Index m)
{
  std::normal_distribution<double> normal;
  const auto fill = [&](Index rows, Index cols) {
    return MatrixXd(MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
  };
  const MatrixXd S = fill(n, n);
  return {S * S.transpose() + 0.1 * MatrixXd::Identity(n, n), fill(n, 1), fill(m, n), fill(m, 1), 0};
}

TEST(QuadraticProgram, Unconstrained)
{
  const QuadraticProgram q{MatrixXd::Identity(2, 2) * 2.0, VectorXd::Constant(2, -4.0), MatrixXd(0, 2),
                           VectorXd(0), 0};
  const QuadraticSolution s = solve(q);
  ASSERT_EQ(s.status, Status::solved);
  EXPECT_NEAR((s.x - VectorXd::Constant(2, 2.0)).norm(), 0.0, 1e-15);
}

TEST(QuadraticProgram, CornerOfATriangle)
{
  // min x1^2/2 + x2^2/2 - x1 - 2 x2, x1 + x2 <= 2, x >= 0 -> (0.5, 1.5).
  QuadraticProgram q{MatrixXd::Identity(2, 2), Eigen::Vector2d(-1, -2), MatrixXd(3, 2),
                     Eigen::Vector3d(-2, 0, 0), 0};
  q.A << -1, -1, 1, 0, 0, 1;
  const QuadraticSolution s = solve(q);
  ASSERT_EQ(s.status, Status::solved);
  EXPECT_NEAR((s.x - Eigen::Vector2d(0.5, 1.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((s.multipliers - Eigen::Vector3d(0.5, 0, 0)).norm(), 0.0, 1e-15);
}

TEST(QuadraticProgram, HockSchittkowski76)
{
  QuadraticProgram q{MatrixXd::Zero(4, 4), Eigen::Vector4d(-1, -3, 1, -1), MatrixXd::Zero(7, 4),
                     VectorXd::Zero(7), 0};
  q.G.diagonal() << 2, 1, 2, 1;
  q.G(0, 2) = q.G(2, 0) = -1.0;
  q.G(2, 3) = q.G(3, 2) = 1.0;
  q.A.row(0) << -1, -2, -1, -1;
  q.A.row(1) << -3, -1, -2, 1;
  q.A.row(2) << 0, 1, 4, 0;
  q.b.head(3) << -5, -4, 1.5;
  q.A.bottomRows(4).setIdentity();
  const QuadraticSolution s = solve(q);
  ASSERT_EQ(s.status, Status::solved);
  EXPECT_NEAR(0.5 * s.x.dot(q.G * s.x) + q.a.dot(s.x), -4.681818181818182, 1e-12);
  expect_kkt(q, s, 1e-12);
}

TEST(QuadraticProgram, AgreesWithEnumerationOfActiveSets)
{
  std::mt19937 random(7);
  int solved = 0;
  int infeasible = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const Index n = 1 + trial % 4;
    const Index m = trial % 9;
    QuadraticProgram q = random_program(random, n, m);
    q.equalities = std::min<Index>(m, trial / 9 % 3);
    const auto expected = enumerate(q);
    const QuadraticSolution s = solve(q);
    if (!expected) {
      ++infeasible;
      EXPECT_EQ(s.status, Status::infeasible) << trial;
      continue;
    }
    ++solved;
    ASSERT_EQ(s.status, Status::solved) << trial;
    EXPECT_LT((s.x - *expected).norm(), 1e-8 * (1.0 + expected->norm())) << trial;
    expect_kkt(q, s, 1e-8 * (1.0 + expected->norm() * q.G.norm()));
  }
  EXPECT_GT(solved, 500);
  EXPECT_GT(infeasible, 50);
}

TEST(QuadraticProgram, DuplicateAndRedundantConstraints)
{
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const QuadraticProgram once = random_program(random, 3, 4);
    const QuadraticSolution expected = solve(once);
    QuadraticProgram twice = once;
    twice.A.resize(13, 3);
    twice.A << once.A, 2.0 * once.A, once.A, MatrixXd::Zero(1, 3);
    twice.b.resize(13);
    twice.b << once.b, 2.0 * once.b, once.b - VectorXd::Constant(4, 1e-13), -1.0;
    const QuadraticSolution s = solve(twice);
    ASSERT_EQ(s.status, expected.status);
    if (s.status != Status::solved) continue;
    EXPECT_LT((s.x - expected.x).norm(), 1e-9 * (1.0 + expected.x.norm()));
  }
}

TEST(QuadraticProgram, DependentEquationsThatAgreeAreOne)
{
  std::mt19937 random(17);
  for (int trial = 0; trial < 300; ++trial) {
    QuadraticProgram once = random_program(random, 4, 3);
    once.equalities = 2;
    const QuadraticSolution expected = solve(once);
    QuadraticProgram thrice = once;
    thrice.equalities = 4;
    thrice.A.resize(5, 4);
    thrice.A << once.A.row(0), once.A.row(1), once.A.row(0) - 3.0 * once.A.row(1), MatrixXd::Zero(1, 4),
        once.A.row(2);
    thrice.b.resize(5);
    thrice.b << once.b[0], once.b[1], once.b[0] - 3.0 * once.b[1], 0.0, once.b[2];
    const QuadraticSolution s = solve(thrice);
    ASSERT_EQ(s.status, Status::solved);
    EXPECT_LT((s.x - expected.x).norm(), 1e-9 * (1.0 + expected.x.norm()));
    EXPECT_EQ(s.multipliers[2], 0.0);
    thrice.b[2] += 1e-3;  // they contradict each other
    EXPECT_EQ(solve(thrice).status, Status::infeasible);
    thrice.b[2] -= 1e-3;
    thrice.b[3] = 1.0;  // 0 = 1
    EXPECT_EQ(solve(thrice).status, Status::infeasible);
  }
}

TEST(QuadraticProgram, EquationAsTwoInequalities)
{
  std::mt19937 random(13);
  for (int trial = 0; trial < 300; ++trial) {
    QuadraticProgram q = random_program(random, 4, 2);
    q.A.row(1) = -q.A.row(0);
    q.b[1] = -q.b[0];
    const QuadraticSolution s = solve(q);
    ASSERT_EQ(s.status, Status::solved);
    EXPECT_NEAR(q.A.row(0).dot(s.x), q.b[0], 1e-11 * (1.0 + std::abs(q.b[0]) * q.G.norm()));
    q.b[1] += 1e-3;  // a gap between the two
    EXPECT_EQ(solve(q).status, Status::infeasible);
  }
}

TEST(QuadraticProgram, DegenerateVertex)
{
  // Six constraints meet in the solution (0, 0) of a plane problem.
  QuadraticProgram q{MatrixXd::Identity(2, 2), Eigen::Vector2d(1, 1), MatrixXd(6, 2), VectorXd::Zero(6)};
  q.A << 1, 0, 0, 1, 1, 1, 2, 1, 1, 2, 1, 0;
  const QuadraticSolution s = solve(q);
  ASSERT_EQ(s.status, Status::solved);
  EXPECT_LT(s.x.norm(), 1e-14);
  expect_kkt(q, s, 1e-13);
}

TEST(QuadraticProgram, IllConditionedHessian)
{
  std::mt19937 random(17);
  for (int trial = 0; trial < 200; ++trial) {
    QuadraticProgram q = random_program(random, 6, 8);
    q.G = VectorXd::LinSpaced(6, -4, 4).unaryExpr([](double e) { return std::pow(10.0, e); }).asDiagonal();
    const QuadraticSolution s = solve(q);
    if (s.status == Status::infeasible) continue;
    ASSERT_EQ(s.status, Status::solved);
    const VectorXd residual = q.G * s.x + q.a - q.A.transpose() * s.multipliers;
    const double size =
        (q.G * s.x).cwiseAbs().maxCoeff() + (q.A.transpose() * s.multipliers).cwiseAbs().maxCoeff();
    EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-9 * (1.0 + size));
    EXPECT_GT((q.A * s.x - q.b).minCoeff(), -1e-7 * (1.0 + s.x.norm()));
  }
}

TEST(QuadraticProgram, BadNumbersFail)
{
  QuadraticProgram q{MatrixXd::Identity(2, 2), VectorXd::Zero(2), MatrixXd::Identity(2, 2),
                     VectorXd::Zero(2)};
  q.G(0, 0) = -1.0;
  EXPECT_EQ(solve(q).status, Status::failed);
  q.G(0, 0) = 1.0;
  q.b[0] = std::nan("");
  EXPECT_EQ(solve(q).status, Status::failed);
  q.b[0] = 1.0;
  q.A.row(0).setZero();
  EXPECT_EQ(solve(q).status, Status::infeasible);
}

}  // namespace
}  // namespace hauberk
