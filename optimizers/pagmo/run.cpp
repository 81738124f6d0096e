#include "candidates.hpp"
#include "pagmo_optimizer.hpp"

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace hauberk {
namespace {

/// Uniform in [-1, 1), the same with every standard library.
double draw(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11U) * 0x1p-52 - 1.0; }

pagmo::algorithm cmaes(const PagmoSettings& settings)
{
  // -1: the rates that Hansen recommends for the number of variables. Draws beyond the bounds are moved onto
  // them.
  return pagmo::algorithm(pagmo::cmaes(settings.generations, -1.0, -1.0, -1.0, -1.0, settings.initial_step,
                                       settings.walk.tolerance, settings.min_step, false, true,
                                       settings.seed));
}

/// The accepted point and others around it.
pagmo::population first_population(const Candidates& candidates, const PagmoSettings& settings)
{
  pagmo::population population(pagmo::problem(candidates), 0U, settings.seed);
  const auto [lower, upper] = candidates.get_bounds();
  const pagmo::vector_double center = candidates.position();
  std::vector<pagmo::vector_double> points{center};
  std::mt19937_64 generator(settings.seed);
  while (points.size() < settings.population) {
    pagmo::vector_double z = center;
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = std::clamp(center[k] + settings.initial_step * draw(generator), lower[k], upper[k]);
    points.push_back(z);
  }
  const std::vector<double> fitness = candidates.fitness_of(points);
  for (std::size_t i = 0; i < points.size(); ++i) population.push_back(points[i], {fitness[i]});
  return population;
}

/// Returns whether the generations were over before the population was small.
bool search(Walk& walk, const PagmoSettings& settings)
{
  const Candidates candidates(walk);
  if (candidates.size() == 0) return false;
  const pagmo::population first = first_population(candidates, settings);
  const pagmo::population last = cmaes(settings).evolve(first);
  walk.restore();  // two inequalities that are an equation are never met by chance
  walk.differentiate();
  return last.get_problem().get_fevals() >= 1ULL * settings.generations * settings.population;
}

}  // namespace

OptimizerResult PagmoOptimizer::do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                            OptimizerObserver& observer) const
{
  PagmoSettings settings = settings_;
  settings.seed = static_cast<unsigned>(seed_of_stream(settings.seed, problem.stream()));
  Walk walk(problem, settings.walk, observer, start);
  std::string why;
  if (!walk.begin(false, why)) return walk.finish("failed", "the start cannot be evaluated: " + why);
  if (walk.stopped() != Walk::Stop::none) return walk.finish_stopped();
  bool over = false;
  try {
    over = search(walk, settings);
  } catch (const Candidates::Stopped&) {
  }
  if (walk.stopped() != Walk::Stop::none) return walk.finish_stopped();
  if (walk.critical()) return walk.finish("converged", "the conditions of first order hold");
  if (walk.infeasible())
    return walk.finish("infeasible", "no small step reduces the violation of the constraints");
  if (over)
    return walk.finish("iteration_limit",
                       "stopped after " + std::to_string(settings.generations) + " generations");
  return walk.finish("small_step", "the population has become small");
}

}  // namespace hauberk
