/// Sparse Hessians: the derivative of the gradient, and systems with them, against dense algebra.

#include <mechanics/curvature.hpp>

#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

/// The sheet, with its mean displacement held.
class HeldSheet final : public Sheet {
 public:
  using Sheet::Sheet;

 protected:
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> rest) const override
  {
    std::vector<LinearEquality> out(2);
    for (int axis = 0; axis < 2; ++axis) {
      for (std::size_t k = 0; k < rest.size(); ++k)
        out[static_cast<std::size_t>(axis)].terms.push_back({static_cast<int>(k), axis, 1.0});
    }
    return out;
  }
};

class SparseHessian : public ::testing::TestWithParam<bool> {
 protected:
  SparseHessian()
      : load_(GetParam() ? std::unique_ptr<LoadCase>(std::make_unique<HeldSheet>(3))
                         : std::unique_ptr<LoadCase>(std::make_unique<Sheet>(3))),
        model_(make_model(chainmail(5, 5), *load_, 0.0)),
        state_(rest_state(model_))
  {
    stage_.contact.g_hat = 0.1;
    stage_.mu = 0.01;
    pull_ = Vector::Zero(3);
    pull_[0] = 1.0;
    std::mt19937_64 rng(3);
    std::normal_distribution<double> normal;
    Vector dy(model_.dofs());
    for (Eigen::Index k = 0; k < dy.size(); ++k) dy[k] = 5e-4 * normal(rng);
    state_ = advanced(model_, state_, free_part(model_, dy), 1.0);
    pairs_ = stage_pairs(model_, state_, stage_);
    energy_ = total_energy(model_, state_, pull_, stage_, pairs_, 2);
  }

  Matrix full() const { return Matrix(energy_.sparse_hessian).selfadjointView<Eigen::Lower>(); }

  std::unique_ptr<LoadCase> load_;
  Model model_;
  State state_;
  Stage stage_;
  Vector pull_;
  std::vector<ElementPair> pairs_;
  TotalEnergy energy_;
};

TEST_P(SparseHessian, IsTheGradientsDerivative)
{
  ASSERT_TRUE(model_.sparse());
  ASSERT_TRUE(energy_.admissible);
  EXPECT_EQ(energy_.hessian.size(), 0);
  const Matrix H = full();
  EXPECT_LT(static_cast<double>(energy_.sparse_hessian.nonZeros()), 0.25 * static_cast<double>(H.size()));
  // Of the strains and displacements, which form a vector space; without the projection onto what is free.
  std::mt19937_64 rng(5);
  std::normal_distribution<double> normal;
  Vector d = Vector::Zero(model_.dofs());
  d.head<3>() = 0.1 * Vec3(normal(rng), normal(rng), normal(rng));
  for (int k = 0; k < model_.element_count(); ++k)
    for (int c = 0; c < 3; ++c) d[model_.offset(k) + c] = normal(rng);
  d = free_part(model_, d);
  const double h = 1e-6;
  const auto gradient = [&](double s) {
    return total_energy(model_, advanced(model_, state_, d, s), pull_, stage_, pairs_, 1).gradient;
  };
  const Vector slope = (gradient(h) - gradient(-h)) / (2.0 * h), expected = free_part(model_, H * d);
  for (int k = 0; k < model_.element_count(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const int at = model_.offset(k) + c;
      EXPECT_NEAR(slope[at], expected[at], 1e-6 * expected.norm());
    }
  }
}

TEST_P(SparseHessian, SystemsAgreeWithDenseOnes)
{
  const Matrix H = full();
  const EliminationOrderHandle order = make_elimination_order();
  const std::unique_ptr<Curvature> c = curvature_of(model_, energy_, *order);
  std::mt19937_64 rng(6);
  std::normal_distribution<double> normal;
  Vector x(model_.dofs());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = normal(rng);
  x = free_part(model_, x);
  EXPECT_LT((c->times(x) - free_part(model_, H * x)).norm(), 1e-12 * H.norm() * x.norm());
  EXPECT_NEAR(c->scale(), (H.diagonal().cwiseAbs().array() / model_.metric.array()).maxCoeff(),
              1e-12 * c->scale());

  // On a basis of what is free.
  const Eigen::Index n = model_.dofs(), held = model_.held.cols();
  Matrix basis = Matrix::Identity(n, n);
  if (held > 0) {
    const Eigen::HouseholderQR<Matrix> qr(model_.held);
    basis = (qr.householderQ() * Matrix::Identity(n, n)).rightCols(n - held);
  }
  const Matrix M = basis.transpose() * model_.metric.asDiagonal() * basis, K = basis.transpose() * H * basis;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eig(K, M);
  const double least = eig.eigenvalues()[0];
  ASSERT_LT(least, -1e-3) << "the state should be a saddle";
  EXPECT_FALSE(c->factor(-0.5 * least));
  const double shift = -2.0 * least;
  ASSERT_TRUE(c->factor(shift));
  const Vector expected = basis * (K + shift * M).llt().solve(basis.transpose() * x);
  EXPECT_LT((c->solve(x) - expected).norm(), 1e-9 * expected.norm());
  Vector direction;
  const double found = c->lowest(100.0 * shift, direction);
  EXPECT_NEAR(found, least, 0.01 * std::abs(least));
  EXPECT_NEAR(step_norm(model_, direction), 1.0, 1e-12);
  EXPECT_NEAR(direction.dot(H * direction), found, 1e-9 * std::abs(found));
}

INSTANTIATE_TEST_SUITE_P(Loads, SparseHessian, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "held" : "free"; });

}  // namespace
}  // namespace hauberk::test
