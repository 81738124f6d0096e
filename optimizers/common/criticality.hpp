#pragma once
/// How far a point is from satisfying the conditions of first order, measured alike by all optimizers.

#include "subproblem.hpp"

namespace hauberk {

/// Largest component of the Lagrangian's gradient, step.gradient - J^T step.multipliers, times the room there
/// is in that direction: |step_lower| or step_upper, at most the range (1). In the objective's unit, zero at
/// a solution.
double optimality(const Step& step, const Eigen::MatrixXd& J, const Eigen::VectorXd& step_lower,
                  const Eigen::VectorXd& step_upper);

/// No small step reduces the violation of the constraints, although it is larger than `tolerance`: the
/// relaxed model could remove next to nothing of it.
bool locally_infeasible(const Step& step, const Linearisation& at, double tolerance);

/// The step along the steepest descent that the linearised constraints and bounds leave, at most one range
/// long: min g.d + s/2 |d|^2 with s the largest component of g. Its multipliers are those of least squares;
/// d = 0 exactly where the conditions of first order hold.
Step steepest_step(const Linearisation& at, const Eigen::VectorXd& step_lower,
                   const Eigen::VectorXd& step_upper, double penalty);

/// The shortest step onto the linearised constraints within the bounds, at most one range long: one of
/// Newton's method towards a feasible point. Not ok where they have no common point.
Step nearest_feasible_step(const Linearisation& at, const Eigen::VectorXd& step_lower,
                           const Eigen::VectorXd& step_upper);

/// The unit of objective values in tolerances: the larger of |value| at the start and now, 1 where both
/// are 0.
double objective_scale(double first_value, double value);

}  // namespace hauberk
