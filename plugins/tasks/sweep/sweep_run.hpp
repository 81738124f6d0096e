#pragma once
/// Limits of one experiment with other values in it, row by row.

#include "run/context.hpp"
#include "run/prepared.hpp"
#include "tasks/sweep/sweep_results.hpp"
#include "tasks/sweep/sweep_section.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// All rows, not computed yet.
SweepTable empty_table(const ExperimentSweep& sweep);

/// `readings`: of the rows. Computes every row that is interrupted in `table`, a row being an item for the
/// threads, until done or interrupted. Results do not depend on the number of threads. What one row throws is
/// its result and does not stop the others.
void run_sweep(const LoadCase& load_case, const std::vector<VariantReading>& readings, RunContext& context,
               SweepTable& table);

/// Whether the computation of any row failed.
bool any_failed(const SweepTable& table);

/// The table as text, and a line for every row that is not done.
std::string sweep_summary(const SweepTable& table);

}  // namespace hauberk
