#include "volumetric_periodic.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <array>
#include <cmath>

namespace hauberk {
namespace {

/// Entries of the symmetric matrix, in the order of the unknowns.
struct Entry {
  Eigen::Index row, column;
};
constexpr std::array<Entry, 6> entries{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// The symmetric matrix with these entries; off-diagonal ones times `shear`.
Mat3 symmetric(std::span<const double> values, double shear)
{
  Mat3 m;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const double value = k < 3 ? values[k] : shear * values[k];
    m(entries[k].row, entries[k].column) = m(entries[k].column, entries[k].row) = value;
  }
  return m;
}

Vec3 eigenvalues(const Mat3& m)
{
  return Eigen::SelfAdjointEigenSolver<Mat3>(m, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Part of the largest one below which a length or a rate is zero up to rounding.
constexpr double zero = 1e-9;

}  // namespace

VolumetricPeriodic::VolumetricPeriodic()
    : macros_{{"exx", 0}, {"eyy", 0}, {"ezz", 0}, {"eyz", 0}, {"exz", 0}, {"exy", 0}}
{
}

void VolumetricPeriodic::do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                                     const Vec3& T, PositionMap& out) const
{
  const Vec3 rest = X + T;
  out.x = rest + symmetric(macro, 1.0) * rest + Vec3(e[0], e[1], e[2]);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    out.J(entries[k].row, column) = rest[entries[k].column];
    out.J(entries[k].column, column) = rest[entries[k].row];
  }
  out.J.block<3, 3>(0, 6).setIdentity();
}

bool VolumetricPeriodic::do_admissible(std::span<const double> macro) const
{
  // F is positive definite: Sylvester's criterion; false for not-a-number.
  const Mat3 F = Mat3::Identity() + symmetric(macro, 1.0);
  return F(0, 0) > 0.0 && F.topLeftCorner<2, 2>().determinant() > 0.0 && F.determinant() > 0.0;
}

std::pair<double, double> VolumetricPeriodic::do_stretch_range(std::span<const double> macro) const
{
  const Vec3 stretches = eigenvalues(Mat3::Identity() + symmetric(macro, 1.0));
  return {stretches[0], stretches[2]};
}

void VolumetricPeriodic::do_load(double theta, std::span<double> t) const
{
  const double c = std::cos(theta), s = std::sin(theta);
  const std::array<double, 6> load{c * c, s * s, 0.0, 0.0, 0.0, 2.0 * c * s};
  std::copy(load.begin(), load.end(), t.begin());
}

double VolumetricPeriodic::do_value(double theta, std::span<const double> macro) const
{
  std::array<double, 6> t{};
  do_load(theta, t);
  double sum = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k) sum += t[k] * macro[k];
  return sum;
}

void VolumetricPeriodic::do_metric(std::span<double> m) const
{
  for (std::size_t k = 0; k < entries.size(); ++k) m[k] = k < 3 ? 1.0 : 2.0;
}

bool VolumetricPeriodic::do_transform(const Mat3& O, std::span<const double> macro,
                                      std::span<double> out) const
{
  const Mat3 turned = O * symmetric(macro, 1.0) * O.transpose();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    out[k] = 0.5 * (turned(entries[k].row, entries[k].column) + turned(entries[k].column, entries[k].row));
  }
  return true;
}

Boundedness VolumetricPeriodic::do_boundedness(std::span<const double> load,
                                               std::span<const Vec3> cycles) const
{
  // The load is the matrix M with load . macro = M : (F - I). Links bound F T for the translations T of their
  // cycles, and packing bounds det F from below. Where cycles span space, admissible F are a compact set.
  // Else let S be their span and N what is across it: of F only its block in N may grow for ever. If that is
  // good (an eigenvalue of M's block in N is positive), the load is unbounded; if it is bad in every
  // direction of N, the best is among a compact set. Where it is neither, growth across is free, and cells
  // that spread across leave room for ever flatter ones: then a load has its limit at taut chains if it pulls
  // along S (its block in S has no negative eigenvalue, and no null vector that it couples with N) and does
  // not act in N at all; any other is only approached.
  const Mat3 M = symmetric(load, 0.5);
  Eigen::Matrix<double, 3, Eigen::Dynamic> T(3, static_cast<Eigen::Index>(cycles.size()));
  for (std::size_t k = 0; k < cycles.size(); ++k) T.col(k) = cycles[k];
  Mat3 axes = Mat3::Identity();
  Eigen::Index spanned = 0;
  if (!cycles.empty()) {
    const Eigen::JacobiSVD<Eigen::Matrix<double, 3, Eigen::Dynamic>> svd(T, Eigen::ComputeFullU);
    axes = svd.matrixU();
    const auto& lengths = svd.singularValues();
    while (spanned < lengths.size() && lengths[spanned] > zero * lengths[0] && lengths[0] > zero) ++spanned;
  }
  if (spanned == 3) return Boundedness::attained;
  const Eigen::MatrixXd turned = axes.transpose() * M * axes;
  const Eigen::Index across = 3 - spanned;
  const double scale = M.norm();
  const auto largest = [](const Eigen::MatrixXd& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  };
  const double growth = largest(turned.bottomRightCorner(across, across));
  if (growth > zero * scale) return Boundedness::unbounded;
  if (growth < -zero * scale) return Boundedness::attained;
  if (spanned == 0 || turned.bottomRightCorner(across, across).norm() > zero * scale)
    return Boundedness::not_attained;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> along(turned.topLeftCorner(spanned, spanned));
  for (Eigen::Index k = 0; k < spanned; ++k) {
    const double coupled = (turned.bottomLeftCorner(across, spanned) * along.eigenvectors().col(k)).norm();
    const double pull = along.eigenvalues()[k];
    if (pull < -zero * scale || (pull <= zero * scale && coupled > zero * scale))
      return Boundedness::not_attained;
  }
  return Boundedness::attained;
}

}  // namespace hauberk
