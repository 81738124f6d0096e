#pragma once
/// The section `sweep` of an experiment.

#include <hauberk/experiment/task_format.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// A place that a swept value goes to, as factor times value plus offset.
struct SweepPlace {
  std::string pointer;
  double factor = 1.0, offset = 0.0;  ///< 1 and 0: any value, else numbers only
};

/// A quantity that is varied: all its places move together.
struct SweepAxis {
  std::string name;
  std::vector<SweepPlace> places;
  std::vector<Node> values;
  bool logarithmic = false;  ///< values are evenly spaced on a logarithmic scale
};

/// What is recorded of every row.
struct SweepMeasure {
  std::string name, pointer;  ///< pointer into the row's results
};

/// The section `sweep`: every combination of the values of its axes is a row.
struct ExperimentSweep : TaskSection {
  std::vector<SweepAxis> axes;
  std::vector<SweepMeasure> measure;  ///< the values of all limits when the file says nothing
  VariantBase base;

  std::size_t row_count() const;
  /// Which value of each axis a row has; the last axis is the fastest.
  std::vector<std::size_t> indices(std::size_t row) const;
};

/// One row of a sweep; `name` is the experiment's.
VariantReading read_sweep_row(const ExperimentSweep& sweep, std::size_t row, const std::string& name,
                              const PluginLookup& lookup, Diagnostics& diagnostics);

/// Reports pointers that lead to nothing in the file, as written or as resolved: a slip of the keyboard would
/// otherwise be refused row by row.
void check_sweep(const TaskSection& section, const Node& resolved, Problems& problems);

/// Its fields.
Field sweep_field();

/// Reads it; names of limits are those of the experiment.
std::shared_ptr<const TaskSection> read_sweep(Node& section, SectionContext& context);

}  // namespace hauberk
