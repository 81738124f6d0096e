#pragma once
/// The quadratic model of a stage's energy at a state, and the steps that a trust region takes of it.

#include "equilibrium/curvature.hpp"

#include <memory>

namespace hauberk {

/// A step dy of the model g . dy + 1/2 dy . H dy.
struct ModelStep {
  Vector dy;
  double lambda = 0.0;     ///< shift: (H + lambda M) dy = -g, M the metric
  double predicted = 0.0;  ///< decrease of the unshifted model, >= 0
  bool shifted = false;    ///< lambda had to exceed the floor that null directions carry
};

/// Follows a stage from state to state, as the order of elimination and a direction of little curvature are
/// worth keeping. Not thread safe.
class QuadraticModel {
 public:
  /// `load_norm`: load_size of the stage's load.
  QuadraticModel(const Model& m, double load_norm) : m_(m), load_norm_(load_norm) {}

  /// Takes the Hessian of the energy at the state that the stage has come to.
  void go_to(const TotalEnergy& e) { curvature_ = curvature_of(m_, e, order_); }

  /// Change of the energy along a step, by the model.
  double change(const TotalEnergy& e, const Vector& dy, double fraction = 1.0) const;

  /// The minimum of the model within the radius (L), by Newton's method on the secular equation 1/|dy| =
  /// 1/radius (Conn, Gould, Toint 2000, section 7.3). A step that is a tenth longer will do. Throws
  /// ComputationError where no shift makes the curvature definite.
  ModelStep newton_step(const TotalEnergy& e, double radius);

  /// Makes of a step at a stationary point one along the most negative curvature; false: there is none that
  /// rounding could not have made.
  bool saddle_step(const TotalEnergy& e, double radius, ModelStep& step);

 private:
  void soften();

  const Model& m_;
  double load_norm_;
  EliminationOrder order_;
  std::unique_ptr<Curvature> curvature_;  ///< of the state's energy
  Vector soft_;  ///< unit length in the step norm, of little curvature when last looked at; or empty
};

}  // namespace hauberk
