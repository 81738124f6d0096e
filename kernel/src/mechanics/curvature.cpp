#include "curvature.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <mutex>
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
    const Eigen::SelfAdjointEigenSolver<Matrix> eig(scaled);
    direction = root.cwiseProduct(eig.eigenvectors().col(0));
    return eig.eigenvalues()[0];
  }

 private:
  const Model& m_;
  const Matrix& hessian_;
  Matrix factor_;
  std::optional<Eigen::LLT<Eigen::Ref<Matrix>>> llt_;
};

using Sparse = Eigen::SparseMatrix<double>;

/// What Eigen's interface to CHOLMOD keeps to itself: the order that an analysis has chosen.
class Ordering : public Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> {
 public:
  explicit Ordering(const Sparse& lower)
  {
    cholmod().print = 0;
    cholmod().error_handler = nullptr;
    // METIS, which CHOLMOD tries where minimum degree leaves much to do, draws random numbers of one generator
    // for the whole process. It seeds it anew each time, so one call at a time is reproducible.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    analyzePattern(lower);
  }

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation() const
  {
    const auto n = static_cast<Eigen::Index>(m_cholmodFactor->n);
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse(n);
    inverse.indices() = Eigen::Map<const Eigen::VectorXi>(static_cast<const int*>(m_cholmodFactor->Perm), n);
    return inverse.inverse();
  }
};

/// In unknowns scaled by the root of the metric, P D H D P^T with D = M^(-1/2) and an elimination order P.
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
    // An order for few contacts is a bad one for many: elimination would fill nearly everything.
    constexpr double more = 1.02;
    if (static_cast<double>(lower.nonZeros()) > more * static_cast<double>(order.entries)) {
      order.entries = lower.nonZeros();
      order.permutation = Ordering(scaled).permutation();
    }
    p_ = order.permutation;
    held_ = p_ * m.held;  // the metric is 1 there
    permuted_.resize(lower.rows(), lower.cols());
    permuted_.selfadjointView<Eigen::Lower>() = scaled.selfadjointView<Eigen::Lower>().twistedBy(p_);
    solver_.cholmod().nmethods = 1;
    solver_.cholmod().method[0].ordering = CHOLMOD_NATURAL;
    solver_.cholmod().print = 0;
    solver_.cholmod().error_handler = nullptr;
    solver_.analyzePattern(permuted_);
  }

  Vector times(const Vector& x) const override
  {
    return free_part(m_, lower_.selfadjointView<Eigen::Lower>() * free_part(m_, x));
  }
  double scale() const override { return permuted_.diagonal().cwiseAbs().maxCoeff(); }

  bool factor(double lambda) override
  {
    shift_ = lambda;
    solver_.setShift(lambda);
    solver_.factorize(permuted_);
    definite_ = solver_.info() == Eigen::Success;
    if (held_.cols() == 0) return definite_;
    Eigen::Index negative = 0;
    if (!definite_) {
      if (!analyzed_) indefinite_.analyzePattern(permuted_);
      analyzed_ = true;
      indefinite_.setShift(lambda);
      indefinite_.factorize(permuted_);
      if (indefinite_.info() != Eigen::Success) return false;
      negative = (indefinite_.vectorD().array() < 0.0).count();
      if (negative > held_.cols()) return false;
    }
    moved_ = unconstrained(held_);
    const Matrix S = held_.transpose() * moved_;
    const Eigen::SelfAdjointEigenSolver<Matrix> inertia(0.5 * (S + S.transpose()));
    if (negative + (inertia.eigenvalues().array() > 0.0).count() != held_.cols()) return false;
    reaction_.compute(S);
    return true;
  }

  Vector solve(const Vector& b) const override
  {
    const Vector right = p_ * root_.cwiseProduct(b);
    Vector x;
    if (held_.cols() == 0) {
      x = solver_.solve(right);
    } else {
      const Vector wanted = without_held(right);
      x = constrained(wanted);
      // Soft motions that are held make K nearly singular; what that costs in digits is got back once.
      const Vector y = root_.cwiseProduct(p_.transpose() * x);
      const Vector reached = p_ * root_.cwiseProduct(lower_.selfadjointView<Eigen::Lower>() * y);
      x += constrained(wanted - without_held(reached + shift_ * x));
    }
    const Vector left = p_.transpose() * x;
    return root_.cwiseProduct(left);
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
  Matrix unconstrained(const Matrix& right) const
  {
    if (definite_) return solver_.solve(right);
    return indefinite_.solve(right);
  }

  Vector without_held(const Vector& x) const { return x - held_ * (held_.transpose() * x); }

  Vector constrained(const Vector& right) const
  {
    const Vector x = unconstrained(right);
    return without_held(x - moved_ * reaction_.solve(held_.transpose() * x));
  }

  const Model& m_;
  const Sparse& lower_;
  Vector root_;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> p_;
  Sparse permuted_;
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> solver_;

  // Of what is held:
  Matrix held_, moved_;                ///< Q and Y, permuted
  Eigen::FullPivLU<Matrix> reaction_;  ///< S
  double shift_ = 0.0;
  bool definite_ = false, analyzed_ = false;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> indefinite_;
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
