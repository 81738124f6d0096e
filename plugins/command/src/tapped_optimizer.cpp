#include "tapped_optimizer.hpp"

namespace hauberk::command {
namespace {

class Tap final : public OptimizerObserver {
 public:
  Tap(const DesignProblem* problem, OptimizerObserver& observer, std::optional<int> most_iterations,
      const TappedOptimizer::Seen& seen)
      : problem_(problem), observer_(observer), most_iterations_(most_iterations), seen_(seen)
  {
  }

  bool on_iterate(const OptimizerIterate& iterate) override
  {
    if (problem_ != nullptr) seen_(iterate, problem_->current());
    const bool wanted = observer_.on_iterate(iterate);
    reached_ = wanted && most_iterations_ && iterate.iteration >= *most_iterations_;
    return wanted && !reached_;
  }

  bool reached() const { return reached_; }

 private:
  const DesignProblem* problem_;
  OptimizerObserver& observer_;
  std::optional<int> most_iterations_;
  const TappedOptimizer::Seen& seen_;
  bool reached_ = false;
};

}  // namespace

OptimizerResult TappedOptimizer::do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                             OptimizerObserver& observer) const
{
  Tap tap(dynamic_cast<const DesignProblem*>(&problem), observer, most_iterations_, seen_);
  OptimizerResult result = inner_.minimize(problem, start, tap);
  if (tap.reached()) {
    result.status = "iteration_limit";
    result.message = "design.max_iterations was reached";
  }
  return result;
}

}  // namespace hauberk::command
