#pragma once
/// Limits of one experiment with other values in it, row by row.

#include "loading.hpp"
#include "progress.hpp"

#include <hauberk/results/sweep.hpp>

#include <functional>

namespace hauberk::command {

/// All rows, not computed yet.
SweepTable empty_table(const Loaded& loaded);

/// The table so far; rows that are not done have status interrupted.
using TableObserver = std::function<void(const SweepTable&)>;

/// Computes every row that is interrupted in `table`, a row being an item for the threads, until done or
/// interrupted. Results do not depend on `threads`. `observer` is called after every row, one call at a time.
/// What one row throws is its result and does not stop the others.
void run_sweep(const Loaded& loaded, unsigned threads, Progress& progress, SweepTable& table,
               const TableObserver& observer);

/// Whether the computation of any row failed.
bool any_failed(const SweepTable& table);

/// The table as text, and a line for every row that is not done.
std::string sweep_summary(const SweepTable& table);

}  // namespace hauberk::command
