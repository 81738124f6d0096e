#pragma once
/// Error against time: every point of a chart solved several times.

#include "run/context.hpp"
#include "tasks/chart/chart_loading.hpp"
#include "tasks/chart/chart_results.hpp"
#include "tasks/chart/chart_section.hpp"

namespace hauberk {

/// All points, not computed yet, in the order of the results.
PrecisionChart empty_chart(const ExperimentChart& chart, const LoadedChart& loaded);

/// Solves references that are not known with the context's threads, then every point that is interrupted in
/// `chart`, one run at a time with the point's own number of threads, until done or interrupted. All points
/// have their first run before any has its second, so that a slow while of the machine does not hit one
/// method alone. Memory is measured in the first run. What one run throws is its result and does not stop the
/// others.
void run_chart(const LoadedChart& loaded, RunContext& context, PrecisionChart& chart);

/// Whether a reference failed, or runs that must be the same differ: then the chart is not what was asked
/// for.
bool any_failed(const PrecisionChart& chart);

}  // namespace hauberk
