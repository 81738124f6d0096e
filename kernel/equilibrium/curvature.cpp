#include "equilibrium/curvature.hpp"

#include "numerics/decompositions.hpp"
#include "numerics/sparse_ldlt.hpp"

#include <cmath>
#include <optional>

namespace hauberk {

namespace {

class DenseCurvature final : public Curvature {
 public:
  DenseCurvature(const Model& m, const Matrix& hessian) : m_(m), hessian_(hessian) {}

  Vector times(const Vector& x) const override { return hessian_ * x; }
  double scale() const override
  {
    return (hessian_.diagonal().cwiseAbs().array() / m_.metric.array()).maxCoeff();
  }
  bool factor(double lambda) override
  {
    factor_ = hessian_;
    factor_.diagonal() += lambda * m_.metric;
    llt_.emplace(factor_);
    return llt_->info() == Eigen::Success;
  }
  Vector solve(const Vector& b) const override { return llt_->solve(b); }
  double lowest(double, Vector& direction) override
  {
    const Vector root = m_.metric.cwiseSqrt().cwiseInverse();
    const Matrix scaled = root.asDiagonal() * hessian_ * root.asDiagonal();
    const SymmetricEigen eigen = symmetric_eigen(scaled);
    direction = root.cwiseProduct(eigen.vectors.col(0));
    return eigen.values[0];
  }

 private:
  const Model& m_;
  const Matrix& hessian_;
  Matrix factor_;
  std::optional<Eigen::LLT<Eigen::Ref<Matrix>>> llt_;
};

/// In unknowns scaled by the root of the metric, D H D with D = M^(-1/2).
///
/// What is held, Q^T x = 0 with k columns, couples all elements, so it is not put into the matrix. With
/// K = H + lambda M, Y = K^-1 Q and S = Q^T Y
///
///     x = K^-1 b - Y S^-1 Q^T K^-1 b
///
/// solves K x + Q n = b, Q^T x = 0 (range-space method). K itself may have negative curvature, along the very
/// motions that are held: it is definite on the others if and only if its negative eigenvalues and the
/// positive ones of S are k together (inertia of the bordered matrix, counted both ways; Gould 1985).
class SparseCurvature final : public Curvature {
 public:
  SparseCurvature(const Model& m, const Sparse& lower, EliminationOrder& order)
      : m_(m), lower_(lower), root_(m.metric.cwiseSqrt().cwiseInverse())
  {
    const Sparse scaled = root_.asDiagonal() * lower * root_.asDiagonal();
    scale_ = scaled.diagonal().cwiseAbs().maxCoeff();
    // An order for few contacts is a bad one for many: elimination would fill nearly everything.
    constexpr double more = 1.02;
    if (static_cast<double>(lower.nonZeros()) > more * static_cast<double>(order.entries)) {
      order.entries = lower.nonZeros();
      order.rows.clear();
    }
    solver_.emplace(scaled, order.rows);
    order.rows = solver_->order();
  }

  Vector times(const Vector& x) const override
  {
    return free_part(m_, lower_.selfadjointView<Eigen::Lower>() * free_part(m_, x));
  }
  double scale() const override { return scale_; }

  bool factor(double lambda) override
  {
    shift_ = lambda;
    const auto held = static_cast<int>(m_.held.cols());
    if (!solver_->factor(lambda, held)) return false;
    if (held == 0) return true;
    moved_ = solver_->solve(m_.held);  // the metric is 1 there
    const Matrix S = m_.held.transpose() * moved_;
    const Vector inertia = symmetric_eigenvalues(0.5 * (S + S.transpose()));
    if (solver_->negative() + (inertia.array() > 0.0).count() != held) return false;
    reaction_.compute(S);
    return true;
  }

  Vector solve(const Vector& b) const override
  {
    const Vector right = root_.cwiseProduct(b);
    if (m_.held.cols() == 0) return root_.cwiseProduct(Vector(solver_->solve(right)));
    const Vector wanted = free_part(m_, right);
    Vector x = constrained(wanted);
    // Soft motions that are held make K nearly singular; what that costs in digits is got back once.
    const Vector reached = root_.cwiseProduct(lower_.selfadjointView<Eigen::Lower>() * root_.cwiseProduct(x));
    x += constrained(wanted - free_part(m_, reached + shift_ * x));
    return root_.cwiseProduct(x);
  }

  double lowest(double positive, Vector& direction) override
  {
    constexpr int most = 200;
    constexpr double settled = 1e-4;
    if (!factor(positive)) return 0.0;
    // Inverse iteration converges the faster the nearer the shift is to the eigenvalue.
    double shift = positive;
    for (int k = 0; k < 10 && factor(0.5 * shift); ++k) shift *= 0.5;
    if (!factor(shift)) return 0.0;
    Vector x = unsymmetric(m_.metric.size());
    double value = 0.0;
    for (int k = 0; k < most; ++k) {
      x = solve(m_.metric.cwiseProduct(x));
      x /= step_norm(m_, x);
      const double next = x.dot(times(x));
      const bool done = k > 3 && std::abs(next - value) <= settled * std::abs(next);
      value = next;
      if (done) break;
    }
    direction = x;
    return value;
  }

 private:
  Vector constrained(const Vector& right) const
  {
    const Vector x = solver_->solve(right);
    return free_part(m_, x - moved_ * reaction_.solve(m_.held.transpose() * x));
  }

  const Model& m_;
  const Sparse& lower_;
  Vector root_;
  double scale_ = 0.0, shift_ = 0.0;
  std::optional<SparseLdlt> solver_;

  // Of what is held:
  Matrix moved_;                       ///< Y
  Eigen::FullPivLU<Matrix> reaction_;  ///< S
};

}  // namespace

Vector unsymmetric(Eigen::Index n)
{
  Vector x(n);
  for (Eigen::Index k = 0; k < n; ++k) x[k] = std::sin(1.0 + 12.9898 * static_cast<double>(k));
  return x;
}

void hold(const Model& m, Matrix& hessian)
{
  hessian -= m.held * (m.held.transpose() * hessian).eval();
  hessian -= (hessian * m.held).eval() * m.held.transpose();
  hessian += std::max(1.0, hessian.diagonal().maxCoeff()) * m.held * m.held.transpose();
}

std::unique_ptr<Curvature> curvature_of(const Model& m, const TotalEnergy& e, EliminationOrder& order)
{
  if (m.sparse()) return std::make_unique<SparseCurvature>(m, e.sparse_hessian, order);
  return std::make_unique<DenseCurvature>(m, e.hessian);
}

}  // namespace hauberk
