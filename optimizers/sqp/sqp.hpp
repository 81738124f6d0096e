#pragma once
/// Sequential quadratic programming for expensive, constrained, possibly kinked objectives.

#include "minimizer.hpp"

#include <hauberk/optimizer.hpp>
#include <hauberk/section.hpp>

#include <common/run_optimizer.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// SQP with a bundle of residuals or a damped BFGS Hessian; see the README for the method. Immutable, thread
/// safe.
using Sqp = RunOptimizer<Minimizer, SqpSettings>;

/// The fields of the optimizer's section of an experiment.
void sqp_fields(std::vector<Field>& out);

/// Builds the optimizer from a section checked against these fields. What contradicts itself goes to
/// `problems`; then null is returned.
std::unique_ptr<Optimizer> make_sqp(const Node& section, Problems& problems);

}  // namespace hauberk
