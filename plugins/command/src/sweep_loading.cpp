#include "sweep_loading.hpp"

namespace hauberk::command {

std::vector<VariantReading> load_sweep(const Experiment& e, const PluginLookup& lookup,
                                       Diagnostics& diagnostics)
{
  const ExperimentSweep& sweep = e.sweep.value();
  std::vector<VariantReading> rows;
  rows.reserve(sweep.row_count());
  for (std::size_t row = 0; row < sweep.row_count(); ++row)
    rows.push_back(read_sweep_row(sweep, row, e.name, lookup, diagnostics));
  return rows;
}

}  // namespace hauberk::command
