#pragma once
#include "design/run_result.hpp"
#include "results/document.hpp"

#include <string>

namespace hauberk::test {

/// Two rings of radius 5 and 4 (parameters ring.R, ring.r), the second turned by 90 degrees about x, in a
/// cell
/// [[12, 0], [0, 100]]; limits of four directions, both senses.
RunResult sample_run();
/// The same with a design of eta.
RunResult sample_design();
std::string sample_experiment();

}  // namespace hauberk::test
