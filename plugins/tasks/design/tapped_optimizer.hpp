#pragma once
/// An optimizer whose iterates can be seen with their variables and scene.

#include "design/design_problem.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace hauberk {

/// Thrown out of a minimisation when the user has interrupted the program.
struct SearchInterrupted {};

/// Forwards to another optimizer. Before the observer hears of an iterate, `seen` is called with the design
/// it belongs to; `most_iterations` ends each minimisation early. An interrupt ends it at the next question
/// to the problem, with SearchInterrupted. Not thread safe: for one design at a time.
class TappedOptimizer final : public Optimizer {
 public:
  using Seen = std::function<void(const DesignPoint&)>;
  TappedOptimizer(const Optimizer& inner, std::optional<int> most_iterations, Seen seen)
      : inner_(inner), most_iterations_(most_iterations), seen_(std::move(seen))
  {
  }

  OptimizerTraits traits() const override { return inner_.traits(); }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override;

 private:
  const Optimizer& inner_;
  std::optional<int> most_iterations_;
  Seen seen_;
};

}  // namespace hauberk
