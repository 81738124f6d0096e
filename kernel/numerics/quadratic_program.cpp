#include "numerics/quadratic_program.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Violation, relative to the numbers that it is the difference of, that counts as none.
constexpr double feasible = 1e-12;
/// The same for a constraint that depends on active ones: it inherits their rounding.
constexpr double feasible_dependent = 1e-8;
/// Part of a unit normal outside the span of the active ones below which it counts as dependent.
constexpr double independent = 1e-9;

/// The program in y = L^T x with G = L L^T, so that the objective is 1/2 |y + g|^2 up to a constant, and with
/// unit normals. The factorisation of the active normals is computed anew on every change: with tens of
/// variables that costs nothing, and no error accumulates.
class DualActiveSet {
 public:
  DualActiveSet(MatrixXd normals, VectorXd offsets, VectorXd g, Index equalities)
      : normals_(std::move(normals)),
        offsets_(std::move(offsets)),
        g_(std::move(g)),
        y_(-g_),
        equalities_(equalities)
  {
  }

  QuadraticSolution::Status run()
  {
    const Index m = normals_.cols();
    ignored_.assign(static_cast<std::size_t>(m), false);
    Index budget = 50 * (m + normals_.rows()) + 100;
    // While only equations are active nothing is dropped: each is added by one full step, in either
    // direction.
    for (Index p = 0; p < equalities_; ++p) {
      double u = 0.0;
      if (!y_.allFinite()) return QuadraticSolution::Status::failed;
      if (advance(p, u) == Progress::infeasible) return QuadraticSolution::Status::infeasible;
    }
    for (Index p = most_violated(); p >= 0; p = most_violated()) {
      double u = 0.0;  // multiplier of p, grown until p is satisfied
      for (bool added = false; !added;) {
        if (--budget < 0 || !y_.allFinite()) return QuadraticSolution::Status::failed;
        const Progress progress = advance(p, u);
        if (progress == Progress::infeasible) return QuadraticSolution::Status::infeasible;
        added = progress == Progress::added;
      }
    }
    return QuadraticSolution::Status::solved;
  }

  const VectorXd& y() const { return y_; }
  VectorXd multipliers() const
  {
    VectorXd all = VectorXd::Zero(normals_.cols());
    for (std::size_t k = 0; k < active_.size(); ++k) all[active_[k]] = u_[k];
    return all;
  }

 private:
  enum class Progress { added, dropped, infeasible };

  double slack(Index i) const { return normals_.col(i).dot(y_) - offsets_[i]; }
  double magnitude(Index i) const { return y_.norm() + g_.norm() + std::abs(offsets_[i]); }

  Index most_violated() const
  {
    Index worst = -1;
    double least = 0.0;
    for (Index i = equalities_; i < normals_.cols(); ++i) {
      if (ignored_[i]) continue;
      if (std::find(active_.begin(), active_.end(), i) != active_.end()) continue;
      const double s = slack(i);
      if (s < least && s < -feasible * magnitude(i)) {
        least = s;
        worst = i;
      }
    }
    return worst;
  }

  /// One step of the method towards satisfying p: a full step makes p active, a partial one drops an active
  /// constraint whose multiplier reached zero.
  Progress advance(Index p, double& u)
  {
    const auto normal = normals_.col(p);
    const VectorXd along = Q_.transpose() * normal;
    VectorXd z = normal - Q_ * along;
    z -= Q_ * (Q_.transpose() * z);  // twice is enough for orthogonality to rounding
    const VectorXd r = R_.triangularView<Eigen::Upper>().solve(along);

    double dual = std::numeric_limits<double>::infinity();
    Index blocking = -1;
    for (Index k = held_; k < r.size(); ++k) {
      if (r[k] > 0.0 && u_[k] / r[k] < dual) {
        dual = u_[k] / r[k];
        blocking = k;
      }
    }
    const double s = slack(p);
    const bool dependent = z.norm() <= independent;
    const double violation = p < equalities_ ? std::abs(s) : -s;
    if (dependent && violation <= feasible_dependent * magnitude(p)) {
      ignored_[p] = true;
      return Progress::added;
    }
    if (dependent && blocking < 0) return Progress::infeasible;
    const double primal = dependent ? std::numeric_limits<double>::infinity() : -s / z.squaredNorm();
    const double t = std::min(primal, dual);
    u_ -= t * r;
    u += t;
    if (!dependent) y_ += t * z;
    if (primal <= dual) {
      active_.push_back(p);
      if (p < equalities_) ++held_;
      u_.conservativeResize(u_.size() + 1);
      u_[u_.size() - 1] = u;
      factorise();
      refresh();
      return Progress::added;
    }
    active_.erase(active_.begin() + blocking);
    for (Index k = blocking; k + 1 < u_.size(); ++k) u_[k] = u_[k + 1];
    u_.conservativeResize(u_.size() - 1);
    clamp();
    factorise();
    return Progress::dropped;
  }

  void factorise()
  {
    const auto q = static_cast<Index>(active_.size());
    if (q == 0) {
      Q_.resize(normals_.rows(), 0);
      R_.resize(0, 0);
      return;
    }
    const MatrixXd N = normals_(Eigen::all, active_);
    const Eigen::HouseholderQR<MatrixXd> qr(N);
    Q_ = qr.householderQ() * MatrixXd::Identity(N.rows(), q);
    R_ = qr.matrixQR().topRows(q).triangularView<Eigen::Upper>();
  }

  /// The minimum with the active constraints as equations, straight from their factorisation:
  /// N^T y = b and y + g = N u.
  void refresh()
  {
    const VectorXd in_span = R_.transpose().triangularView<Eigen::Lower>().solve(VectorXd(offsets_(active_)));
    const VectorXd g_in_span = Q_.transpose() * g_;
    y_ = Q_ * (in_span + g_in_span) - g_;
    u_ = R_.triangularView<Eigen::Upper>().solve(in_span + g_in_span);
    clamp();
  }

  /// What rounding leaves of multipliers of inequalities below zero.
  void clamp()
  {
    for (Index k = held_; k < u_.size(); ++k) u_[k] = std::max(u_[k], 0.0);
  }

  MatrixXd normals_;  // n x m, unit columns
  VectorXd offsets_;
  VectorXd g_;
  VectorXd y_;
  Index equalities_;  // the first constraints
  Index held_ = 0;    // of them in active_, where they come first
  std::vector<Index> active_;
  std::vector<bool> ignored_;  // dependent on active ones and satisfied up to rounding
  VectorXd u_ = VectorXd(0);   // multipliers of the active constraints
  MatrixXd Q_ = MatrixXd(normals_.rows(), 0);
  MatrixXd R_ = MatrixXd(0, 0);
};

}  // namespace

QuadraticSolution solve(const QuadraticProgram& program)
{
  QuadraticSolution solution;
  const Eigen::LLT<MatrixXd> llt(program.G);
  if (llt.info() != Eigen::Success || !program.a.allFinite() || !program.A.allFinite() ||
      !program.b.allFinite()) {
    return solution;
  }
  const auto L = llt.matrixL();
  // Constraints without a normal say 0 >= b or 0 = b: true and left out, or infeasible.
  MatrixXd normals = program.A.transpose();
  if (normals.cols() > 0) L.solveInPlace(normals);  // Eigen's triangular solver refers to the first column
  VectorXd offsets = program.b;
  VectorXd norms = normals.colwise().norm();
  for (Index i = 0; i < norms.size(); ++i) {
    if (norms[i] > 0.0) {
      normals.col(i) /= norms[i];
      offsets[i] /= norms[i];
    } else if (offsets[i] > 0.0 || (i < program.equalities && offsets[i] < 0.0)) {
      solution.status = QuadraticSolution::Status::infeasible;
      return solution;
    } else {
      norms[i] = 1.0;
    }
  }
  DualActiveSet method(std::move(normals), std::move(offsets), L.solve(program.a), program.equalities);
  solution.status = method.run();
  if (solution.status != QuadraticSolution::Status::solved) return solution;
  solution.x = llt.matrixU().solve(method.y());
  solution.multipliers = method.multipliers().cwiseQuotient(norms);
  return solution;
}

}  // namespace hauberk
