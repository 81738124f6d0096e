#pragma once
/// An optimizer each of whose runs is an object.

#include <hauberk/optimizer.hpp>

#include <span>

namespace hauberk {

/// Minimises by Run(problem, settings, observer, start).run(). Immutable, thread safe where different runs
/// share nothing.
template <class Run, class Settings>
class RunOptimizer final : public Optimizer {
 public:
  explicit RunOptimizer(const Settings& settings) : settings_(settings) {}

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    return Run(problem, settings_, observer, start).run();
  }

 private:
  Settings settings_;
};

}  // namespace hauberk
