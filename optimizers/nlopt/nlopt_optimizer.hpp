#pragma once
/// Algorithms of NLopt as optimizers.

#include <hauberk/optimizer.hpp>
#include <hauberk/section.hpp>

#include <common/walk.hpp>

#include <memory>
#include <vector>

namespace hauberk {

enum class NloptAlgorithm { slsqp, mma, ccsaq, lbfgs, cobyla };

/// Steps and optimality are measured in variables scaled by their ranges.
struct NloptSettings {
  NloptAlgorithm algorithm = NloptAlgorithm::slsqp;
  WalkSettings walk;
  unsigned memory = 20;        ///< of lbfgs, steps; 0: the library's choice
  double initial_step = 0.05;  ///< of cobyla, part of a variable's range
  double min_step = 1e-7;      ///< changes below this are none, part of a variable's range
};

/// See the README for how NLopt is made to keep the contract. Thread safe.
class NloptOptimizer final : public Optimizer {
 public:
  explicit NloptOptimizer(const NloptSettings& settings) : settings_(settings) {}
  /// mma and ccsaq keep no equations.
  OptimizerTraits traits() const override;

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override;

 private:
  NloptSettings settings_;
};

/// The fields of the optimizer's section of an experiment.
void nlopt_fields(std::vector<Field>& out);

/// Builds the optimizer from a section checked against these fields. What contradicts itself goes to
/// `problems`; then null is returned.
std::unique_ptr<Optimizer> make_nlopt(const Node& section, Problems& problems);

}  // namespace hauberk
