#pragma once
/// CMA-ES of pagmo as an optimizer.

#include <hauberk/optimizer.hpp>
#include <hauberk/section.hpp>

#include <common/walk.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// Steps are measured in variables scaled by their ranges.
struct PagmoSettings {
  WalkSettings walk;
  unsigned seed = 1;
  unsigned population = 20;
  unsigned generations = 200;
  double initial_step = 0.1;  ///< standard deviation of the first draws
  double min_step = 1e-7;     ///< distance between points of a population that has converged
};

/// See the README for how populations are made to keep the contract. Thread safe. The same settings and
/// stream of the problem give the same result.
class PagmoOptimizer final : public Optimizer {
 public:
  explicit PagmoOptimizer(const PagmoSettings& settings) : settings_(settings) {}
  /// A population never meets an equation.
  OptimizerTraits traits() const override
  {
    OptimizerTraits traits;
    traits.thread_safe = traits.stochastic = true;
    return traits;
  }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override;

 private:
  PagmoSettings settings_;
};

/// The fields of the optimizer's section of an experiment.
void pagmo_fields(std::vector<Field>& out);

/// Builds the optimizer from a section checked against these fields. What contradicts itself goes to
/// `problems`; then null is returned.
std::unique_ptr<Optimizer> make_pagmo(const Node& section, Problems& problems);

}  // namespace hauberk
