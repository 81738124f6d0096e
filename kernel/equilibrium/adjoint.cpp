#include "equilibrium/adjoint.hpp"

#include "equilibrium/curvature.hpp"
#include "model/near_pairs.hpp"
#include "numerics/decompositions.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace hauberk {
namespace {

/// Step of the differences, as part of the smallest gap over the motion: forces go like 1/gap, so the error
/// of fourth order is about 4 step^4, below the noise of fine quadrature over the step.
constexpr double step_of_gap = 3e-3;
/// Curvatures below this part of the largest are rounding, and below this part of the load (L = 1)
/// quadrature: contact forces have the load's size, and bend with curvatures of order 1.
constexpr double rounding_of_curvature = 1e-13;
constexpr double quadrature = 1e-7;

/// Least-squares solution of H a = b in the step norm, and |H a - b| / |b| in its dual.
Vector solve(const Matrix& H, const Vector& b, const Vector& metric, double load, double& residual)
{
  const Vector root = metric.cwiseSqrt().cwiseInverse();
  const Matrix scaled = root.asDiagonal() * H * root.asDiagonal();
  const auto [values, vectors, converged] = symmetric_eigen(0.5 * (scaled + scaled.transpose()));
  const double least = std::max(rounding_of_curvature * values.cwiseAbs().maxCoeff(), quadrature * load);
  const Vector right = root.cwiseProduct(b);
  Vector part = vectors.transpose() * right;
  for (Eigen::Index i = 0; i < part.size(); ++i)
    part[i] = std::abs(values[i]) > least ? part[i] / values[i] : 0.0;
  const Vector z = vectors * part;
  residual = (scaled * z - right).norm() / right.norm();
  return root.cwiseProduct(z);
}

}  // namespace

AdjointGradient adjoint_gradient(const Model& model, const State& state, const Vector& load,
                                 const Stage& stage, const Vector& quantity)
{
  AdjointGradient out;
  Stage fine = stage;  // differences would see the panels of rough quadrature
  fine.contact.quadrature = Quadrature::fine;
  const std::vector<ElementPair> pairs = stage_pairs(model, state, fine);
  const TotalEnergy e = total_energy(model, state, load, fine, pairs, 2);
  out.evaluations = e.contact.evaluations;
  if (!e.admissible) throw ComputationError("adjoint: the state touches; it is no minimum of a stage");
  Request request;
  request.order = 1;
  request.parameters = true;
  const auto explicit_at = [&](const State& s) {
    const ContactEnergy c = contact_energy(model, s, pairs, fine.contact, request);
    out.evaluations += c.evaluations;
    if (!(c.min_gap > 0.0)) throw ComputationError("adjoint: a state of the differences touches");
    return Matrix(fine.mu * c.parameters);
  };
  if (quantity.squaredNorm() == 0.0) {
    out.parameters = Matrix::Zero(explicit_at(state).rows(), model.element_count());
    return out;
  }
  Matrix hessian = e.hessian;
  if (model.sparse()) {
    hessian = Matrix(e.sparse_hessian).selfadjointView<Eigen::Lower>();
    if (model.held.cols() > 0) hold(model, hessian);
  }
  const Vector a = solve(hessian, free_part(model, quantity), model.metric, load.norm(), out.residual);
  // What elements move by themselves, and by the macroscopic unknowns, whose metric is that displacement's.
  const int nm = model.macro_count;
  const double motion = largest_motion(model, a) +
                        std::sqrt((model.metric.head(nm).array() * a.head(nm).array().square()).sum());
  const double s = motion > 0.0 ? step_of_gap * e.contact.min_gap / motion : 1.0;
  const auto difference = [&](double by) {
    return Matrix(explicit_at(advanced(model, state, a, by)) - explicit_at(advanced(model, state, a, -by)));
  };
  out.parameters = -(8.0 * difference(s) - difference(2.0 * s)) / (12.0 * s);
  return out;
}

std::optional<Vector> response_of_minimum(const Model& model, const Model& ahead, double share,
                                          const State& state, const Vector& load, const Stage& stage,
                                          long& evaluations)
{
  Stage fine = stage;  // a difference would see the panels of rough quadrature
  fine.contact.quadrature = Quadrature::fine;
  const TotalEnergy here = total_energy(model, state, load, fine, stage_pairs(model, state, fine), 2);
  const TotalEnergy there = total_energy(ahead, state, load, fine, stage_pairs(ahead, state, fine), 1);
  evaluations += here.contact.evaluations + there.contact.evaluations;
  if (!here.admissible || !there.admissible) return std::nullopt;
  constexpr double soft = 1e-3;  // of the load
  EliminationOrder order;
  const std::unique_ptr<Curvature> curvature = curvature_of(model, here, order);
  if (!curvature->factor(soft * load_size(model, load))) return std::nullopt;
  return curvature->solve(free_part(model, (here.gradient - there.gradient) / share));
}

}  // namespace hauberk
