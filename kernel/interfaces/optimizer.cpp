#include <hauberk/error.hpp>
#include <hauberk/optimizer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace hauberk {
namespace {

constexpr std::array<std::string_view, 6> known_status = {"converged", "small_step", "iteration_limit",
                                                          "stopped",   "infeasible", "failed"};

void check_start(std::span<const double> lower, std::span<const double> upper, std::span<const double> start)
{
  if (lower.size() != upper.size() || start.size() != lower.size()) {
    throw InputError(fmt::format("optimizer: start has {} variables, bounds have {} and {}", start.size(),
                                 lower.size(), upper.size()));
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!(start[i] >= lower[i] && start[i] <= upper[i]) || !std::isfinite(start[i])) {
      throw InputError(fmt::format("optimizer: variable {} starts at {:g}, outside its bounds [{:g}, {:g}]",
                                   i, start[i], lower[i], upper[i]));
    }
  }
}

void check_constraints(const OptimizationProblem& problem, const OptimizerTraits& traits)
{
  const int all = problem.constraint_count(), equalities = problem.equality_count();
  if (equalities < 0 || equalities > all) {
    throw InputError(
        fmt::format("optimizer: {} of the problem's {} constraints are equations", equalities, all));
  }
  if (equalities > 0 && !traits.equalities) {
    throw InputError(fmt::format(
        "optimizer: the problem has {} equality constraint{}, and this one keeps none; choose one that "
        "does, which 'hauberk plugins describe' tells of each",
        equalities, equalities == 1 ? "" : "s"));
  }
}

void check_result(std::span<const double> lower, std::span<const double> upper, const OptimizerResult& result)
{
  if (std::find(known_status.begin(), known_status.end(), result.status) == known_status.end()) {
    throw PluginError("optimizer: unknown status '" + result.status + "'");
  }
  if (result.x.size() != lower.size()) {
    throw PluginError(
        fmt::format("optimizer: returned {} variables, expected {}", result.x.size(), lower.size()));
  }
  for (std::size_t i = 0; i < result.x.size(); ++i) {
    if (!std::isfinite(result.x[i])) {
      throw PluginError(fmt::format("optimizer: variable {} is not finite", i));
    }
    if (result.x[i] < lower[i] || result.x[i] > upper[i]) {
      throw PluginError(fmt::format("optimizer: variable {} = {:g} is outside its bounds [{:g}, {:g}]", i,
                                    result.x[i], lower[i], upper[i]));
    }
  }
  // A run whose start could not be evaluated has no value to give.
  if (result.status != "failed" && !std::isfinite(result.value)) {
    throw PluginError("optimizer: the value is not finite");
  }
}

}  // namespace

void OptimizationProblem::check_batch(std::size_t count, std::span<const double> points) const
{
  const std::size_t n = lower().size();
  if (points.size() == count * n) return;
  throw PluginError(fmt::format("optimizer: a batch of {} points of {} variables has {} numbers, expected {}",
                                count, n, points.size(), count * n));
}

std::vector<OptimizationProblem::Evaluation> OptimizationProblem::evaluate_batch(
    std::size_t count, std::span<const double> points, bool want_gradient)
{
  check_batch(count, points);
  const std::size_t n = lower().size();
  std::vector<Evaluation> found;
  found.reserve(count);
  for (std::size_t i = 0; i < count; ++i) found.push_back(evaluate(points.subspan(i * n, n), want_gradient));
  return found;
}

bool OptimizationProblem::hessian_product(std::span<const double> /*x*/, double /*weight*/,
                                          std::span<const double> /*multipliers*/,
                                          std::span<const double> /*v*/, std::span<double> /*out*/)
{
  return false;
}

std::uint64_t seed_of_stream(std::uint64_t seed, std::uint64_t stream)
{
  if (stream == 0) return seed;
  std::uint64_t z = seed + stream * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

OptimizerResult Optimizer::minimize(OptimizationProblem& problem, std::span<const double> start,
                                    OptimizerObserver& observer) const
{
  check_start(problem.lower(), problem.upper(), start);
  check_constraints(problem, traits());
  OptimizerResult result = do_minimize(problem, start, observer);
  check_result(problem.lower(), problem.upper(), result);
  return result;
}

}  // namespace hauberk
