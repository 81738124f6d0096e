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

OptimizerResult Optimizer::minimize(OptimizationProblem& problem, std::span<const double> start,
                                    OptimizerObserver& observer) const
{
  check_start(problem.lower(), problem.upper(), start);
  OptimizerResult result = do_minimize(problem, start, observer);
  check_result(problem.lower(), problem.upper(), result);
  return result;
}

}  // namespace hauberk
