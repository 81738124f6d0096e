#include "criticality.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Part of the violation that the relaxed model must be able to remove, or the point is a minimum of it.
constexpr double removable = 1e-6;

}  // namespace

double optimality(const Step& step, const Eigen::MatrixXd& J, const Eigen::VectorXd& step_lower,
                  const Eigen::VectorXd& step_upper)
{
  const Eigen::VectorXd gradient = step.gradient - J.transpose() * step.multipliers;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double room = std::min(1.0, gradient[i] > 0.0 ? -step_lower[i] : step_upper[i]);
    largest = std::max(largest, std::abs(gradient[i]) * room);
  }
  return largest;
}

bool locally_infeasible(const Step& step, const Linearisation& at, double tolerance)
{
  return step.elastic && largest_violation(at) > tolerance &&
         step.model_violation >= (1.0 - removable) * total_violation(at);
}

Step steepest_step(const Linearisation& at, const Eigen::VectorXd& step_lower,
                   const Eigen::VectorXd& step_upper, double penalty)
{
  const Eigen::Index n = at.gradient.size();
  const double steepest = n == 0 ? 0.0 : at.gradient.cwiseAbs().maxCoeff();
  const double curvature = steepest > 0.0 ? steepest : 1.0;
  return propose_step(curvature * Eigen::MatrixXd::Identity(n, n), at, step_lower.cwiseMax(-1.0),
                      step_upper.cwiseMin(1.0), penalty);
}

Step nearest_feasible_step(const Linearisation& at, const Eigen::VectorXd& step_lower,
                           const Eigen::VectorXd& step_upper)
{
  const Eigen::Index n = step_lower.size();
  const Linearisation constraints{Eigen::VectorXd::Zero(n), at.c, at.J, at.equalities};
  Step step = propose_step(Eigen::MatrixXd::Identity(n, n), constraints, step_lower.cwiseMax(-1.0),
                           step_upper.cwiseMin(1.0), 0.0);
  step.ok = step.ok && !step.elastic;
  return step;
}

double objective_scale(double first_value, double value)
{
  const double scale = std::max(std::abs(first_value), std::abs(value));
  return scale > 0.0 ? scale : 1.0;
}

}  // namespace hauberk
