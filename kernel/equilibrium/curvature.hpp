#pragma once
/// The Hessian of the energy as Newton's method uses it: dense for few unknowns, sparse for many.

#include "equilibrium/stage.hpp"

#include <memory>

namespace hauberk {

/// Held directions Q of a dense Hessian become directions without coupling, and stiff ones, so that rounding
/// moves nothing there: P H P + s Q Q^T with P = I - Q Q^T.
void hold(const Model& m, Matrix& hessian);

/// A vector that no symmetry makes orthogonal to an eigenvector: where iterations for one start.
Vector unsymmetric(Eigen::Index n);

/// Systems with H + lambda M, M the metric, on the motions that the load case leaves: solutions have no held
/// part.
class Curvature {
 public:
  virtual ~Curvature() = default;

  virtual Vector times(const Vector& x) const = 0;
  /// Largest |H_kk| / M_kk.
  virtual double scale() const = 0;
  /// Prepares `solve`; false: H + lambda M is not positive definite on these motions.
  virtual bool factor(double lambda) = 0;
  virtual Vector solve(const Vector& b) const = 0;
  /// Smallest eigenvalue of H against M and its direction, of unit length in the step norm. `positive`: a
  /// shift for which `factor` succeeded. Sparse: an upper bound, from inverse iteration.
  virtual double lowest(double positive, Vector& direction) = 0;
};

/// What stays from one Hessian of a stage to the next while contacts do not become more: the order of
/// elimination, chosen for a Hessian with so many entries.
struct EliminationOrder {
  Eigen::Index entries = 0;
  std::vector<int> rows;
};

/// Of the energy, with the storage that it has.
std::unique_ptr<Curvature> curvature_of(const Model& m, const TotalEnergy& e, EliminationOrder& order);

}  // namespace hauberk
