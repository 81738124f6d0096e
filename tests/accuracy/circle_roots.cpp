#include "circle_roots.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>

namespace hauberk::brute {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Coefficients of z^-n .. z^n of a trigonometric polynomial.
using Coefficients = std::vector<Complex>;

Coefficients product(const Coefficients& a, const Coefficients& b)
{
  Coefficients c(a.size() + b.size() - 1, Complex(0.0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

/// c0 + cc cos u + cs sin u.
Coefficients first_degree(double c0, double cc, double cs)
{
  return {Complex(0.5 * cc, 0.5 * cs), Complex(c0), Complex(0.5 * cc, -0.5 * cs)};
}

Coefficients sum(Coefficients a, const Coefficients& b, double factor)
{
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
  return a;
}

}  // namespace

std::vector<BruteMinimum> circle_minima(const Torus& P, const Torus& F)
{
  const Mat3 turn = F.axes.transpose() * P.axes;
  const Vec3 a = F.axes.transpose() * (P.center - F.center);
  const Vec3 e = P.R * turn.col(0), f = P.R * turn.col(1);
  const auto x = first_degree(a.x(), e.x(), f.x()), y = first_degree(a.y(), e.y(), f.y());
  const auto dx = first_degree(0.0, f.x(), -e.x()), dy = first_degree(0.0, f.y(), -e.y());
  const auto slope = first_degree(0.0, a.dot(f), -a.dot(e));  // p . p' = a . p'
  const Coefficients rho2 = sum(product(x, x), product(y, y), 1.0);
  const Coefficients pull = sum(product(x, dx), product(y, dy), 1.0);
  const Coefficients poly = sum(product(rho2, product(slope, slope)), product(pull, pull), -F.R * F.R);

  double scale = 0.0;
  for (const Complex& c : poly) scale = std::max(scale, std::abs(c));
  std::vector<BruteMinimum> out;
  const Field field{P, F};
  if (std::abs(poly.back()) < 1e-13 * scale || scale == 0.0) return out;  // degenerate: caller skips
  Eigen::Matrix<Complex, 8, 8> companion = Eigen::Matrix<Complex, 8, 8>::Zero();
  for (int k = 0; k < 8; ++k) {
    companion(k, 7) = -poly[k] / poly[8];
    if (k > 0) companion(k, k - 1) = 1.0;
  }
  const Eigen::ComplexEigenSolver<Eigen::Matrix<Complex, 8, 8>> solver(companion, false);
  std::vector<double> angles;
  for (int k = 0; k < 8; ++k) {
    const Complex z = solver.eigenvalues()[k];
    if (std::abs(std::abs(z) - 1.0) < 1e-3) angles.push_back(std::arg(z));
  }
  if (angles.empty()) return out;
  std::sort(angles.begin(), angles.end());
  // Between neighbouring candidates the slope has at most one change of sign of interest: look around each.
  const auto n = angles.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double before = k > 0 ? angles[k - 1] : angles[n - 1] - 2.0 * pi;
    const double after = k + 1 < n ? angles[k + 1] : angles[0] + 2.0 * pi;
    double lo = 0.5 * (before + angles[k]), hi = 0.5 * (angles[k] + after), glo, ghi, unused;
    if (n == 1) {
      lo = angles[0] - pi;
      hi = angles[0] + pi;
    }
    field.value(lo, 0.0, glo, unused);
    field.value(hi, 0.0, ghi, unused);
    if (!(glo < 0.0 && ghi > 0.0)) continue;
    for (int it = 0; it < 100; ++it) {
      const double mid = 0.5 * (lo + hi);
      field.value(mid, 0.0, glo, unused);
      (glo < 0.0 ? lo : hi) = mid;
    }
    out.push_back({lo, 0.0, field.value(lo, 0.0)});
  }
  std::sort(out.begin(), out.end(), [](const auto& p, const auto& q) { return p.distance < q.distance; });
  return out;
}

}  // namespace hauberk::brute
