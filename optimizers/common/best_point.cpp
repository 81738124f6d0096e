#include "best_point.hpp"

#include <cmath>
#include <utility>

namespace hauberk {

bool BestPoint::improved_by(double value, double violation) const
{
  if (!any_) return true;
  const bool now_feasible = violation <= tolerance_;
  if (now_feasible != feasible()) return now_feasible;
  return now_feasible ? value < value_ : violation < violation_;
}

bool BestPoint::offer(const Eigen::VectorXd& x, double value, double violation)
{
  if (!improved_by(value, violation)) return false;
  any_ = true;
  x_ = x;
  value_ = value;
  violation_ = violation;
  return true;
}

void BestPoint::looked_again(double told, double value)
{
  if (value > told + surprise * std::abs(told)) any_ = false;
}

OptimizerResult BestPoint::result(std::string status, std::string message, const Eigen::VectorXd& start,
                                  double value) const
{
  OptimizerResult result;
  const Eigen::VectorXd& x = any_ ? x_ : start;
  result.x.assign(x.begin(), x.end());
  result.value = any_ ? value_ : value;
  if (any_ && !feasible()) {
    if (status == "small_step" || status == "converged") status = "infeasible";
    message +=
        "; the constraints are violated by up to " + std::to_string(violation_) + " in their own scale";
  }
  result.status = std::move(status);
  result.message = std::move(message);
  return result;
}

}  // namespace hauberk
