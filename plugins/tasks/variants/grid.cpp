#include "tasks/variants/grid.hpp"

#include "numerics/parallel.hpp"
#include "run/interrupt.hpp"

#include <exception>
#include <mutex>
#include <utility>

namespace hauberk {
namespace {

EnterRow outcome_of(GridRows& rows, std::size_t row)
{
  const VariantReading& variant = rows.variant(row);
  if (!variant.experiment) return rows.refuse(row, RowStatus::refused, variant.refusal);
  try {
    return rows.solve(row, *variant.experiment);
  } catch (const InputError& error) {
    return rows.refuse(row, RowStatus::refused, error.what());
  } catch (const std::exception& error) {
    return rows.refuse(row, RowStatus::failed, error.what());
  }
}

}  // namespace

Grid::Grid(RunContext& context, std::string name, std::size_t left)
    : context_(context), name_(std::move(name)), left_(left)
{
  context_.progress.limits(name_, 0, left_);
}

void Grid::run(GridRows& rows, std::span<const std::size_t> order, unsigned threads)
{
  std::mutex mutex;  // guards results, display and files
  parallel_for(order.size(), threads, [&](std::size_t k) {
    if (interrupted()) return;
    const EnterRow enter = outcome_of(rows, order[k]);
    if (!enter) return;
    const std::lock_guard lock(mutex);
    done_ += enter();
    context_.progress.limits(name_, done_, left_);
    context_.save_sometimes();
  });
}

}  // namespace hauberk
