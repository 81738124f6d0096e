#include "tasks/variants/grid.hpp"

#include "numerics/parallel.hpp"
#include "run/interrupt.hpp"

#include <atomic>
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

Grid::Grid(RunContext& context, std::string name, std::size_t total)
    : context_(context), name_(std::move(name)), total_(total)
{
  context_.progress.limits(name_, 0, total_);
}

void Grid::run(GridRows& rows, std::span<const std::size_t> order, unsigned threads)
{
  std::mutex mutex;  // guards results, display and files
  std::atomic<bool> broken = false;
  parallel_for(order.size(), threads, [&](std::size_t k) {
    if (broken || interrupted()) return;
    const EnterRow enter = outcome_of(rows, order[k]);
    if (!enter) return;
    const std::lock_guard lock(mutex);
    try {
      done_ += enter();
    } catch (...) {
      broken = true;
      throw;
    }
    context_.progress.limits(name_, done_, total_);
    context_.save_sometimes();
  });
}

}  // namespace hauberk
