#pragma once
/// Interior points of Ipopt as an optimizer.

#include <hauberk/optimizer.hpp>
#include <hauberk/section.hpp>

#include <common/walk.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// Variables and objective are scaled by their ranges and by the objective at the start.
struct IpoptSettings {
  WalkSettings walk;
  int memory = 20;         ///< steps that the Hessian is made of
  double barrier = 0.01;   ///< first barrier parameter, relative to the objective
  double push = 0.01;      ///< distance of the first iterate from the bounds, part of a variable's range
  double min_step = 1e-7;  ///< shortest step worth an evaluation, part of a variable's range
};

/// See the README for how Ipopt is made to keep the contract. Not thread safe: Ipopt 3.11 numbers its vectors
/// by a global counter, and MUMPS, its linear solver, keeps its state in global variables.
class IpoptOptimizer final : public Optimizer {
 public:
  explicit IpoptOptimizer(const IpoptSettings& settings) : settings_(settings) {}
  OptimizerTraits traits() const override
  {
    OptimizerTraits traits;
    traits.equalities = true;
    return traits;
  }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override;

 private:
  IpoptSettings settings_;
};

/// The fields of the optimizer's section of an experiment.
void ipopt_fields(std::vector<Field>& out);

/// Builds the optimizer from a section checked against these fields.
std::unique_ptr<Optimizer> make_ipopt(const Node& section, Problems& problems);

}  // namespace hauberk
