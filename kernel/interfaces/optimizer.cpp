#include <hauberk/error.hpp>
#include <hauberk/optimizer.hpp>

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
    throw InputError("optimizer: start has " + std::to_string(start.size()) + " variables, bounds have " +
                     std::to_string(lower.size()) + " and " + std::to_string(upper.size()));
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!(start[i] >= lower[i] && start[i] <= upper[i]) || !std::isfinite(start[i])) {
      throw InputError("optimizer: variable " + std::to_string(i) + " starts at " + std::to_string(start[i]) +
                       ", outside its bounds [" + std::to_string(lower[i]) + ", " + std::to_string(upper[i]) +
                       "]");
    }
  }
}

void check_result(std::span<const double> lower, std::span<const double> upper, const OptimizerResult& result)
{
  if (std::find(known_status.begin(), known_status.end(), result.status) == known_status.end()) {
    throw PluginError("optimizer: unknown status '" + result.status + "'");
  }
  if (result.x.size() != lower.size()) {
    throw PluginError("optimizer: returned " + std::to_string(result.x.size()) + " variables, expected " +
                      std::to_string(lower.size()));
  }
  for (std::size_t i = 0; i < result.x.size(); ++i) {
    if (!std::isfinite(result.x[i])) {
      throw PluginError("optimizer: variable " + std::to_string(i) + " is not finite");
    }
    if (result.x[i] < lower[i] || result.x[i] > upper[i]) {
      throw PluginError("optimizer: variable " + std::to_string(i) + " = " + std::to_string(result.x[i]) +
                        " is outside its bounds [" + std::to_string(lower[i]) + ", " +
                        std::to_string(upper[i]) + "]");
    }
  }
  // A run whose start could not be evaluated has no value to give.
  if (result.status != "failed" && !std::isfinite(result.value)) {
    throw PluginError("optimizer: the value is not finite");
  }
}

}  // namespace

OptimizerResult Optimizer::minimize(OptimizationProblem& problem, std::span<const double> start,
                                    OptimizerObserver& observer) const
{
  check_start(problem.lower(), problem.upper(), start);
  OptimizerResult result = do_minimize(problem, start, observer);
  check_result(problem.lower(), problem.upper(), result);
  return result;
}

}  // namespace hauberk
