#include "candidates.hpp"

#include <algorithm>
#include <optional>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Where a variable has no bound, populations stay this near to the start, in its unit.
constexpr double farthest = 100.0;
/// Larger violations are not told apart.
constexpr double largest_told = 1e100;

double behind(double violation) { return Candidates::infeasible * (1.0 + std::min(violation, largest_told)); }

}  // namespace

Candidates::Candidates(Walk& walk) : walk_(&walk)
{
  const ScaledProblem& problem = walk.problem();
  const VectorXd z = problem.scaled(walk.accepted().x);
  const VectorXd lower =
      problem.scaled(problem.lower()).cwiseMax(z.array().matrix() - VectorXd::Constant(z.size(), farthest));
  const VectorXd upper = problem.scaled(problem.upper()).cwiseMin(z + VectorXd::Constant(z.size(), farthest));
  for (Index i = 0; i < z.size(); ++i) {
    if (!(lower[i] < upper[i])) continue;
    free_.push_back(i);
    lower_.push_back(lower[i]);
    upper_.push_back(upper[i]);
  }
}

pagmo::vector_double Candidates::position() const
{
  const VectorXd z = walk_->problem().scaled(walk_->accepted().x);
  pagmo::vector_double position;
  for (std::size_t k = 0; k < size(); ++k) position.push_back(std::clamp(z[free_[k]], lower_[k], upper_[k]));
  return position;
}

pagmo::vector_double Candidates::fitness(const pagmo::vector_double& z) const
{
  VectorXd all = walk_->problem().scaled(walk_->accepted().x);
  for (std::size_t k = 0; k < size(); ++k) all[free_[k]] = z[k];
  const VectorXd x = walk_->problem().unscaled(all);
  // Where a point is known that satisfies the constraints, the value of one that does not has no use.
  if (walk_->best().feasible()) {
    const std::optional<double> violation = walk_->violation(x);
    if (!violation) return {unreachable};
    if (*violation > walk_->tolerated()) return {behind(*violation)};
  }
  const Walk::Place& place = walk_->look(x, false);
  if (walk_->stopped() != Walk::Stop::none) throw Stopped();
  if (!place.ok) return {unreachable};
  double value = place.value;
  const double violation = largest_violation(place.at.c);
  if (walk_->improved_by(place)) {
    walk_->accept_last();
    value = walk_->accepted().value;
    if (walk_->stopped() != Walk::Stop::none) throw Stopped();
  }
  if (violation > walk_->tolerated()) return {behind(violation)};
  return {std::min(value / walk_->unit(), infeasible)};
}

}  // namespace hauberk
