#pragma once
/// The published contact (paper equations (2) to (4) and (9) to (11)): the barrier of every local minimum of
/// the squared distance between two charts, faded by the smallest eigenvalue of the distance's Hessian.

#include "contact/formulation.hpp"
#include "contact/torus_pair.hpp"

#include <Eigen/Eigenvalues>

#include <vector>

namespace hauberk::published {

/// Thresholds of the paper: lambda_bar = 1e-9, d_1 = 1e-12 and d_2 = 4e-12 beside d_hat = 1e-8, all in m^2.
/// As squared lengths they are kept in these proportions to d_hat = g_hat^2, whatever g_hat is.
inline constexpr double lambda_bar = 0.1;
inline constexpr double d1 = 1e-4;
inline constexpr double d2 = 4e-4;

/// Squared distance at which a step counts as a collision: 1e-20 m^2, in d_hat.
inline constexpr double d_th = 1e-12;

/// Width of the smooth minimum of two eigenvalues, see `soft_minimum`, in lambda_bar.
inline constexpr double eigenvalue_width = 0.01;

/// b/d_hat^2 with b of equation (4), x = d/d_hat: -(1 - x)^2 ln x below 1, else 0.
template <typename S>
S barrier(const S& x)
{
  using std::log;
  if (value_of(x) >= 1.0) return S(0.0);
  const S y = 1.0 - x;
  return -(y * y * log(x));
}

/// Equation (9) with n = 5, y = lambda/lambda_bar: h = 5 y^4 - 4 y^5 between 0 and 1.
template <typename S>
S fade(const S& y)
{
  if (value_of(y) <= 0.0) return S(0.0);
  if (value_of(y) >= 1.0) return S(1.0);
  const S y2 = y * y;
  return y2 * y2 * (5.0 - 4.0 * y);
}

/// Equation (10), x = d/d_hat: s = h where the gap is wide, 1 where it is tiny.
template <typename S>
S smooth_factor(const S& x, const S& h)
{
  if (value_of(x) >= d2) return h;
  if (value_of(x) <= d1) return S(1.0);
  const S t = (x - d1) * (1.0 / (d2 - d1)), u = 1.0 - t;
  return h * (t * t * (3.0 - 2.0 * t)) + u * u * (1.0 + 2.0 * t);
}

/// Smooth symmetric stand-in for min(a, c) of the two eigenvalues of [[a, b], [b, c]]:
///
///   1/2 (a + c) - sqrt(1/4 (a - c)^2 + b^2 + width^2).
///
/// The smallest eigenvalue itself has a cone where two are equal, and neither a gradient nor an eigenvector
/// there. That is no rare place: two equal perpendicular rings, the links of a plain chain, have it by
/// symmetry. Any function of trace and determinant is symmetric in the two eigenvalues and so as smooth as
/// the matrix is; this one lies below the smallest by at most `width`, by width^2/(c - a) where they are
/// apart, and needs no eigenvector of its own.
template <typename S>
S soft_minimum(const S& a, const S& b, const S& c, double width)
{
  using std::sqrt;
  const S half = 0.5 * (a - c);
  return 0.5 * (a + c) - sqrt(half * half + b * b + width * width);
}

/// The 2 x 2 matrix whose eigenvalues are the two smallest of H(z), from the eigenvectors V and values l of
/// H(0), l_0 <= l_1 < l_2 <= l_3: with A = V^T H V, i of {0, 1},
///
///   B_ii = A_ii + sum_{k = 2, 3} A_ik^2/(l_i - l_k),   B_01 = A_01
///
/// (quasi-degenerate perturbation theory: H in a basis turned by exp(K), K chosen to first order so that the
/// blocks decouple). B_01 vanishes at z = 0 and counts as its square, so its first order suffices: trace and
/// determinant of B have errors of third order, also where l_0 = l_1.
///
/// The two groups are apart: J = (V_P,u, V_P,v, -V_F,u, -V_F,v) has rank two at a minimum, where both tangent
/// planes are parallel, and H = 2 J^T J + O(gap). So l_2 is of the order of the squared tube radii, while
/// l_0 and l_1 are proportional to the gap. A fade that is active with l_1 near l_2 would need tubes thinner
/// than the activation distance; the differences are bounded away from zero so that nothing diverges then.
template <typename S>
std::array<S, 3> lowest_block(const std::array<std::array<S, 4>, 4>& H, const Eigen::Matrix4d& V,
                              const Eigen::Vector4d& l)
{
  const double least = 1e-6 * l[3];
  std::array<std::array<S, 4>, 2> A;
  for (int i = 0; i < 2; ++i) {
    std::array<S, 4> Hv;
    for (std::size_t r = 0; r < 4; ++r) {
      Hv[r] = V(0, i) * H[r][0];
      for (int c = 1; c < 4; ++c) Hv[r] += V(c, i) * H[r][c];
    }
    for (int k = 0; k < 4; ++k) {
      S& x = A[i][k];
      x = V(0, k) * Hv[0];
      for (int r = 1; r < 4; ++r) x += V(r, k) * Hv[r];
    }
  }
  std::array<S, 3> B{A[0][0], A[0][1], A[1][1]};
  for (std::size_t k = 2; k < 4; ++k) {
    const double lk = l[k];
    B[0] += (1.0 / std::min(l[0] - lk, -least)) * (A[0][k] * A[0][k]);
    B[2] += (1.0 / std::min(l[1] - lk, -least)) * (A[1][k] * A[1][k]);
  }
  return B;
}

/// A local minimum of the squared distance over the four chart coordinates.
struct PublishedMinimum {
  TorusCoordinates<double> c{};
  double d = 0.0;
  Eigen::Vector4d eigenvalues;   ///< of H = d_cc, rising
  Eigen::Matrix4d eigenvectors;  ///< columns
  bool converged = false;        ///< a stationary point with positive semi-definite H, to rounding
};

/// Chart coordinates of both surface points from a minimum of P's probe set of dimension `dim` in F's field.
template <int dim>
TorusCoordinates<double> chart_start(const PairFrame& frame, const Minimum& m);

/// Full Newton steps from `c` until the norm of the gradient decreases no further (paper, below eq. (3)).
PublishedMinimum refine(const TorusPair<double>& pair, TorusCoordinates<double> c, int& evaluations);

/// The paper's search: samples of both surfaces as starting points, Newton's method from those that are
/// locally nearest. Nothing certifies that no minimum is missed. Nearest first; never empty.
std::vector<PublishedMinimum> sampled_minima(const PairFrame& frame, int& evaluations);

}  // namespace hauberk::published
