// The threefold element with round tubes: exact stretch, and a compression whose symmetric path ends at a
// saddle.

#include "limit_cases.hpp"
#include "motion/advancement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

namespace hauberk::brute {
namespace {

TEST(Threefold, StretchAlongALatticeDirectionIsExact)
{
  const double exact = (2.0 * 4.25 + 2.0 * 2.575 - 2.0 * 0.95) / test::threefold_spacing;
  for (const double direction : {90.0, 30.0, 150.0}) {
    for (const bool fast : {false, true}) {
      const LimitResult r = limit(test::threefold_round(), direction, Sense::positive,
                                  fast ? fast_settings() : LimitSettings{});
      ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
      const double error = (1.0 + *r.value) / exact - 1.0;
      fmt::print(
          "threefold stretch at {} {}: value {:.12f}, exact {:.12f}, relative error of 1 + value {:.1e}\n",
          direction, fast ? "fast" : "accurate", *r.value, exact - 1.0, error);
      EXPECT_NEAR(error, 0.0, fast ? 1e-3 : 1e-8);
    }
  }
}

/// Symmetric equilibrium of one stage: only exx and eyy move, by Newton with certified steps.
State symmetric_equilibrium(const Model& m, State s, const Vector& load, const Stage& stage)
{
  for (int it = 0; it < 200; ++it) {
    const TotalEnergy e = total_energy(m, s, load, stage, stage_pairs(m, s, stage), 2);
    const Eigen::Vector2d g = e.gradient.head<2>();
    Eigen::Matrix2d H = e.hessian.topLeftCorner<2, 2>();
    const double low = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(H).eigenvalues()[0];
    H.diagonal().array() += std::max(0.0, 0.1 - low);
    Vector dy = Vector::Zero(m.dofs());
    dy.head<2>() = -H.inverse() * g;
    if (dy.norm() > 0.02) dy *= 0.02 / dy.norm();
    if (dy.norm() < 1e-13) break;
    double t = largest_safe_step(m, s, dy, 0.1).alpha;
    for (int k = 0; k < 40; ++k, t *= 0.5) {
      const State next = advanced(m, s, dy, t);
      const TotalEnergy n = total_energy(m, next, load, stage, stage_pairs(m, next, stage), 0);
      if (n.admissible && n.energy <= e.energy) {
        s = next;
        break;
      }
    }
  }
  return s;
}

TEST(Threefold, CompressionLeavesTheSymmetricSaddle)
{
  const test::Sheet sheet(2);
  const SceneSpec scene = test::threefold_round();
  const Model m = make_model(scene, sheet, 0.0);
  const Vector load = load_vector(m, Direction::at_degrees(90.0), Sense::negative);
  Stage stage;
  stage.contact = {Formulation::arc, 0.03, 0.0};
  State symmetric = rest_state(m);
  for (const double g_hat : {0.03, 0.01, 0.003, 0.001}) {
    stage.contact.g_hat = g_hat;
    stage.mu = 0.03 * g_hat;
    symmetric = symmetric_equilibrium(m, symmetric, load, stage);
  }
  // Stationary in every unknown by symmetry, but no minimum.
  const TotalEnergy e = total_energy(m, symmetric, load, stage, stage_pairs(m, symmetric, stage), 2);
  EXPECT_LT(e.gradient.cwiseAbs().maxCoeff(), 1e-6);
  const Vector root = m.metric.cwiseSqrt().cwiseInverse();
  const Matrix H = root.asDiagonal() * e.hessian * root.asDiagonal();
  const double lowest = Eigen::SelfAdjointEigenSolver<Matrix>(H).eigenvalues()[0];
  EXPECT_LT(lowest, -1e-2);

  const LimitResult perturbed = limit(scene, 90.0, Sense::negative);
  LimitSettings none;
  none.perturbation = 0.0;
  const LimitResult unperturbed = limit(scene, 90.0, Sense::negative, none);
  ASSERT_EQ(perturbed.status, LimitStatus::locked) << perturbed.message;
  ASSERT_EQ(unperturbed.status, LimitStatus::locked) << unperturbed.message;
  fmt::print(
      "threefold compression at 90: symmetric state {:.6f} (lowest curvature {:.3f}); from unperturbed rest "
      "{:.9f}, from perturbed rest {:.9f}\n",
      symmetric.macro[1], lowest, *unperturbed.value, *perturbed.value);
  EXPECT_LT(*perturbed.value, symmetric.macro[1] - 1e-3);
  EXPECT_LT(*unperturbed.value, symmetric.macro[1] - 1e-3);
}

}  // namespace
}  // namespace hauberk::brute
