#pragma once
/// The engine of every task that solves many variants of a file (rows of a sweep, points of a chart, members
/// of families): what is left is solved row by row, refused where there is no such variant, entered, shown
/// and saved, until all is done or a signal stops it.

#include "run/context.hpp"
#include "tasks/variants/row_status.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/experiment.hpp>

#include <boost/json/array.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// Puts the outcome of a row into the task's results and says by how much the display goes on. An empty one
/// leaves them as they are.
using EnterRow = std::function<std::size_t()>;

/// What a task gives the engine. `solve` and `refuse` are called by several threads at a time and change
/// nothing that another row reads; what they return is called by one thread at a time.
class GridRows {
 public:
  virtual ~GridRows() = default;
  /// The variant that a row solves, or why there is none.
  virtual const VariantReading& variant(std::size_t row) const = 0;
  /// Solves a row. What it throws is the row's outcome: InputError refuses it, any other std::exception fails
  /// it. Of a row that a signal stopped it returns nothing to enter.
  virtual EnterRow solve(std::size_t row, const Experiment& experiment) = 0;
  /// The outcome of a row without an answer.
  virtual EnterRow refuse(std::size_t row, RowStatus status, const std::string& message) = 0;
};

/// One walk through the rows of a task, which the display calls `name`.
class Grid {
 public:
  /// `total`: what the entries of all rows to come add up to.
  Grid(RunContext& context, std::string name, std::size_t total);

  /// Works through rows in this order, `threads` (0: all processors) at a time. Results do not depend on
  /// `threads` where those of the rows do not. Rows that a signal stops, or keeps from being begun, are left.
  /// Throws what an entry throws; then no other row is begun.
  void run(GridRows& rows, std::span<const std::size_t> order, unsigned threads);

 private:
  RunContext& context_;
  std::string name_;
  std::size_t done_ = 0, total_;
};

/// The memory of a run for one of its rows; of a run that has none, none.
class RowMemory {
 public:
  RowMemory(const RunContext& context, std::size_t row);
  SearchMemory* get() { return memory_ ? &*memory_ : nullptr; }

 private:
  std::optional<MemoryWithin> memory_;
};

/// Solves a share of variants, each as if it were alone, for the context's memory. The display calls them
/// `name`.
void run_rows_of_part(RunContext& context, const std::string& name, std::span<const VariantReading> readings,
                      const Share& share);

/// Takes over what partial results of the same experiment hold: `take(entry, row)` enters an entry, or says
/// false when it is of another row. Throws InputError ("its rows are not complete") when they are not the
/// same in number and order, and what Boost.JSON throws for entries that lack something; rows are of no use
/// then.
template <class Row, class Take>
void take_rows(const boost::json::array& entries, std::vector<Row>& rows, const char* what, const Take& take)
{
  if (entries.size() != rows.size()) throw InputError(std::string("its ") + what + " are not complete");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!take(entries[k], rows[k])) throw InputError(std::string("its ") + what + " are in another order");
  }
}

}  // namespace hauberk
