#include "numerics/damped_bfgs.hpp"

#include <Eigen/Eigenvalues>

namespace hauberk {
namespace {

/// Least part of the curvature along a step that an update leaves (Powell).
constexpr double damping = 0.2;
/// Smallest eigenvalue, relative to the largest: keeps the QP's Cholesky factor accurate.
constexpr double eigenvalue_floor = 1e-10;

}  // namespace

void DampedBfgs::reset(Eigen::Index n, double curvature)
{
  B_ = curvature * Eigen::MatrixXd::Identity(n, n);
  fresh_ = true;
}

void DampedBfgs::update(const Eigen::VectorXd& s, const Eigen::VectorXd& y)
{
  const double ss = s.squaredNorm();
  const double sy = s.dot(y);
  if (!(ss > 0.0) || !y.allFinite() || !s.allFinite()) return;
  // The first curvature that is seen sets the scale in all directions; the larger of the usual two choices,
  // y.y/s.y, makes short steps, which cost less than steps that have to be taken back.
  if (fresh_ && sy > 0.0) B_ = y.squaredNorm() / sy * Eigen::MatrixXd::Identity(s.size(), s.size());
  const Eigen::VectorXd Bs = B_ * s;
  const double sBs = s.dot(Bs);
  const double theta = sy >= damping * sBs ? 1.0 : (1.0 - damping) * sBs / (sBs - sy);
  const Eigen::VectorXd r = theta * y + (1.0 - theta) * Bs;
  const Eigen::MatrixXd next = B_ + r * r.transpose() / s.dot(r) - Bs * Bs.transpose() / sBs;
  if (!next.allFinite()) return;

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(0.5 * (next + next.transpose()));
  const double largest = spectrum.eigenvalues().maxCoeff();
  if (spectrum.info() != Eigen::Success || !(largest > 0.0)) return;
  const Eigen::VectorXd shifted = spectrum.eigenvalues().cwiseMax(eigenvalue_floor * largest);
  B_ = spectrum.eigenvectors() * shifted.asDiagonal() * spectrum.eigenvectors().transpose();
  B_ = (0.5 * (B_ + B_.transpose())).eval();
  fresh_ = false;
}

}  // namespace hauberk
