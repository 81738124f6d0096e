#pragma once
/// Quasi-Newton minimisation within bounds, constraints by an augmented Lagrangian.

#include "minimizer.hpp"

#include <hauberk/optimizer.hpp>
#include <hauberk/section.hpp>

#include <common/run_optimizer.hpp>

#include <memory>
#include <vector>

namespace hauberk {

/// Projected BFGS with an augmented Lagrangian; see the README for the method. Immutable, thread safe.
using Bfgs = RunOptimizer<BfgsMinimizer, BfgsSettings>;

/// The fields of the optimizer's section of an experiment.
void bfgs_fields(std::vector<Field>& out);

/// Builds the optimizer from a section checked against these fields. What contradicts itself goes to
/// `problems`; then null is returned.
std::unique_ptr<Optimizer> make_bfgs(const Node& section, Problems& problems);

}  // namespace hauberk
