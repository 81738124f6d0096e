#pragma once
/// An optimizer each of whose runs is an object.

#include <hauberk/optimizer.hpp>

#include <span>

namespace hauberk {

/// Minimises by Run(problem, settings, observer, start).run(). Runs share nothing and keep equations. Thread
/// safe.
template <class Run, class Settings>
class RunOptimizer final : public Optimizer {
 public:
  explicit RunOptimizer(const Settings& settings) : settings_(settings) {}

  OptimizerTraits traits() const override
  {
    OptimizerTraits traits;
    traits.thread_safe = traits.equalities = true;
    return traits;
  }

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
