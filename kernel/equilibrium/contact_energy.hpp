#pragma once
/// Contact energy of a whole state: sum over pairs of bodies and walls, in the model's unknowns.

#include "contact/formulation.hpp"
#include "model/model.hpp"
#include "model/near_pairs.hpp"
#include "motion/gap_bounds.hpp"

#include <Eigen/SparseCore>

namespace hauberk {

/// Energy (without stiffness) and derivatives with respect to all unknowns.
struct ContactEnergy {
  double energy = 0.0;
  Vector gradient;
  Matrix hessian;  ///< of models with few unknowns
  /// Of models with many (Model::sparse), their lower triangle.
  Eigen::SparseMatrix<double> sparse_hessian;
  double min_gap = std::numeric_limits<double>::infinity();  ///< smallest gap seen; <= 0: not admissible
  double regularity = std::numeric_limits<double>::infinity();
  long evaluations = 0;      ///< closest-point evaluations
  double d_clearance = 0.0;  ///< d energy / d clearance (scaled)
  Matrix parameters;         ///< d energy / d parameters: column k = element k, file units (see below)
  struct Point {
    int a = 0, b = 0;  ///< bodies; walls: a = element, b = -1
    Image image{};
    ContactPoint contact;  ///< world; normal from a to b; on_p on a, on_f on b
    int wall = -1;
  };
  std::vector<Point> points;
};

/// Evaluates the contact energy over the given element pairs. `parameters` (d energy/d element parameter) is
/// in 1/(file unit of length): scaled derivatives times 1/L. Deterministic: pairs are summed in their order.
/// Thread safe. Pairs and panels that `bounds`, if given, certifies to be out of range are not looked at.
ContactEnergy contact_energy(const Model& model, const State& state, const std::vector<ElementPair>& pairs,
                             const ContactSettings& settings, const Request& request,
                             const GapBounds* bounds = nullptr);

}  // namespace hauberk
