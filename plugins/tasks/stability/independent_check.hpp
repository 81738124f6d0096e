#pragma once
/// What the independent check says about the limits of one experiment.

#include "design/run_result.hpp"
#include "limits/limit_result.hpp"
#include "tasks/stability/stability_results.hpp"

#include <hauberk/verify/verify.hpp>

#include <string>
#include <vector>

namespace hauberk {

/// Makes the results file of `run` in memory and has it checked as `hauberk verify` would: a line per limit.
/// `experiment_json` is the resolved experiment. Thread safe.
std::vector<VerifyLine> independent_check(const RunResult& run, const std::string& experiment_json,
                                          const std::vector<std::string>& macro_names);

/// Enters what a limit claims, and what the check said about it, into a case.
void enter_claim(StabilityCase& into, const LimitResult& limit, const VerifyLine& check);

}  // namespace hauberk
