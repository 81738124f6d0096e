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

VectorXd Candidates::point(const pagmo::vector_double& z) const
{
  VectorXd all = walk_->problem().scaled(walk_->accepted().x);
  for (std::size_t k = 0; k < size(); ++k) all[free_[k]] = z[k];
  return walk_->problem().unscaled(all);
}

std::optional<double> Candidates::ruled_out(const VectorXd& x) const
{
  // Where a point is known that satisfies the constraints, the value of one that does not has no use.
  if (!walk_->best().feasible()) return std::nullopt;
  const std::optional<double> violation = walk_->violation(x);
  if (!violation) return unreachable;
  if (*violation > walk_->tolerated()) return behind(*violation);
  return std::nullopt;
}

double Candidates::rank(const Walk::Place& place) const
{
  if (!place.ok) return unreachable;
  const double violation = largest_violation(place.at);
  if (violation > walk_->tolerated()) return behind(violation);
  return std::min(place.value / walk_->unit(), infeasible);
}

pagmo::vector_double Candidates::fitness(const pagmo::vector_double& z) const
{
  const VectorXd x = point(z);
  if (const std::optional<double> known = ruled_out(x)) return {*known};
  const Walk::Place place = walk_->look(x, false);
  if (walk_->stopped() != Walk::Stop::none) throw Stopped();
  if (!place.ok || !walk_->improved_by(place)) return {rank(place)};
  walk_->accept_last();
  if (walk_->stopped() != Walk::Stop::none) throw Stopped();
  return {rank(walk_->accepted())};
}

std::vector<double> Candidates::fitness_of(const std::vector<pagmo::vector_double>& points) const
{
  std::vector<double> fitness(points.size());
  std::vector<std::size_t> asked;
  std::vector<VectorXd> there;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const VectorXd x = point(points[i]);
    const std::optional<double> known = ruled_out(x);
    if (known) {
      fitness[i] = *known;
    } else {
      asked.push_back(i);
      there.push_back(x);
    }
  }
  const std::vector<Walk::Place> places = walk_->look(there, false);
  std::size_t best = places.size();
  for (std::size_t k = 0; k < places.size(); ++k) {
    fitness[asked[k]] = rank(places[k]);
    const bool better = best == places.size() || fitness[asked[k]] < fitness[asked[best]];
    if (places[k].ok && walk_->improved_by(places[k]) && better) best = k;
  }
  if (best < places.size()) {
    walk_->accept(places[best]);
    fitness[asked[best]] = rank(walk_->accepted());
  }
  if (walk_->stopped() != Walk::Stop::none) throw Stopped();
  return fitness;
}

}  // namespace hauberk
