/// Sparse Hessians: the derivative of the gradient, and systems with them, against dense algebra.

#include "equilibrium/curvature.hpp"

#include "model/near_pairs.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

class SparseHessian : public ::testing::Test {
 protected:
  SparseHessian() : load_(3), model_(make_model(chainmail(5, 5), load_, 0.0)), state_(rest_state(model_))
  {
    stage_.contact.g_hat = 0.1;
    stage_.mu = 0.01;
    pull_ = Vector::Zero(3);
    pull_[0] = 1.0;
    std::mt19937_64 rng(3);
    std::normal_distribution<double> normal;
    Vector dy(model_.dofs());
    for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = 5e-4 * normal(rng);
    state_ = advanced(model_, state_, dy, 1.0);
    pairs_ = stage_pairs(model_, state_, stage_);
    energy_ = total_energy(model_, state_, pull_, stage_, pairs_, 2);
  }

  Matrix full() const { return Matrix(energy_.sparse_hessian).selfadjointView<Eigen::Lower>(); }

  Sheet load_;
  Model model_;
  State state_;
  Stage stage_;
  Vector pull_;
  std::vector<ElementPair> pairs_;
  TotalEnergy energy_;
};

TEST_F(SparseHessian, IsTheGradientsDerivative)
{
  ASSERT_TRUE(model_.sparse());
  ASSERT_TRUE(energy_.admissible);
  EXPECT_EQ(energy_.hessian.size(), 0);
  const Matrix H = full();
  EXPECT_LT(static_cast<double>(energy_.sparse_hessian.nonZeros()), 0.25 * static_cast<double>(H.size()));
  // Of the strains and displacements, which form a vector space; .
  std::mt19937_64 rng(5);
  std::normal_distribution<double> normal;
  Vector d = Vector::Zero(model_.dofs());
  d.head<3>() = 0.1 * Vec3(normal(rng), normal(rng), normal(rng));
  for (int k = 0; k < model_.element_count(); ++k)
    for (int c = 0; c < 3; ++c) d[model_.offset(k) + c] = normal(rng);
  const double h = 1e-6;
  const auto gradient = [&](double s) {
    return total_energy(model_, advanced(model_, state_, d, s), pull_, stage_, pairs_, 1).gradient;
  };
  const Vector slope = (gradient(h) - gradient(-h)) / (2.0 * h), expected = H * d;
  for (int k = 0; k < model_.element_count(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const int at = model_.offset(k) + c;
      EXPECT_NEAR(slope[at], expected[at], 1e-6 * expected.norm());
    }
  }
}

TEST_F(SparseHessian, SystemsAgreeWithDenseOnes)
{
  const Matrix H = full();
  EliminationOrder order;
  const std::unique_ptr<Curvature> c = curvature_of(model_, energy_, order);
  std::mt19937_64 rng(6);
  std::normal_distribution<double> normal;
  Vector x(model_.dofs());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = normal(rng);
  EXPECT_LT((c->times(x) - H * x).norm(), 1e-12 * H.norm() * x.norm());
  EXPECT_NEAR(c->scale(), (H.diagonal().cwiseAbs().array() / model_.metric.array()).maxCoeff(),
              1e-12 * c->scale());

  const Matrix M = model_.metric.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eig(H, M);
  const double least = eig.eigenvalues()[0];
  ASSERT_LT(least, -1e-3) << "the state should be a saddle";
  EXPECT_FALSE(c->factor(-0.5 * least));
  const double shift = -2.0 * least;
  ASSERT_TRUE(c->factor(shift));
  const Vector expected = (H + shift * M).llt().solve(x);
  EXPECT_LT((c->solve(x) - expected).norm(), 1e-9 * expected.norm());
  Vector direction;
  const double found = c->lowest(100.0 * shift, direction);
  EXPECT_NEAR(found, least, 0.01 * std::abs(least));
  EXPECT_NEAR(step_norm(model_, direction), 1.0, 1e-12);
  EXPECT_NEAR(direction.dot(H * direction), found, 1e-9 * std::abs(found));
}

/// Directions that are held, among them the one of most negative curvature, which may leave the rest
/// definite.
TEST_F(SparseHessian, HeldDirectionsAreLeftOutAsInDenseAlgebra)
{
  const Matrix M = model_.metric.asDiagonal();
  const Matrix free_hessian = full();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eig(free_hessian, M);
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal;
  // What coordinates have of the most negative curvature, and two more: all held directions are of
  // coordinates.
  Matrix rows = Matrix::Zero(model_.dofs(), 3);
  for (int k = 0; k < model_.element_count(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const int at = model_.offset(k) + c;
      rows(at, 0) = eig.eigenvectors()(at, 0);
      rows(at, 1) = c == 0 ? 1.0 : 0.0;
      rows(at, 2) = normal(rng);
    }
  }
  const Eigen::HouseholderQR<Matrix> qr(rows);
  model_.held = qr.householderQ() * Matrix::Identity(model_.dofs(), 3);
  energy_ = total_energy(model_, state_, pull_, stage_, pairs_, 2);
  ASSERT_LT(free_part(model_, energy_.gradient).norm(), energy_.gradient.norm() * (1.0 + 1e-12));

  Matrix H = free_hessian;
  hold(model_, H);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> held(H, M);
  const double least = held.eigenvalues()[0];
  ASSERT_GT(least, eig.eigenvalues()[0] + 1e-4) << "what is held should make a difference";
  EliminationOrder order;
  const std::unique_ptr<Curvature> c = curvature_of(model_, energy_, order);
  int indefinite = 0;
  // Between the two spectra K is indefinite and the rest is not; below, neither is.
  for (const double part : {-0.5, 0.02, 0.3, 0.7, 0.98, 1.02, 3.0}) {
    const double shift = -least + part * (least - eig.eigenvalues()[0]);
    const bool definite = (H + shift * M).llt().info() == Eigen::Success;
    EXPECT_EQ(c->factor(shift), definite) << part;
    if (!definite) continue;
    indefinite += (free_hessian + shift * M).llt().info() == Eigen::Success ? 0 : 1;
    const Vector expected = free_part(model_, (H + shift * M).llt().solve(energy_.gradient));
    EXPECT_LT((c->solve(energy_.gradient) - expected).norm(), 1e-9 * expected.norm()) << part;
    EXPECT_LT((model_.held.transpose() * c->solve(energy_.gradient)).norm(), 1e-12 * expected.norm()) << part;
  }
  EXPECT_GE(indefinite, 3);
  Vector direction;
  const double found = c->lowest(1.0 - least, direction);
  EXPECT_NEAR(found, least, 0.01 * std::abs(least));
  EXPECT_LT((model_.held.transpose() * direction).norm(), 1e-12);
  Vector x(model_.dofs());
  for (double& v : x) v = normal(rng);
  EXPECT_LT((c->times(x) - free_part(model_, free_hessian * free_part(model_, x))).norm(),
            1e-12 * H.norm() * x.norm());
}

}  // namespace
}  // namespace hauberk::test
