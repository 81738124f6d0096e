#include "tasks/variants/grid.hpp"

#include "numerics/parallel.hpp"
#include "run/interrupt.hpp"
#include "run/variant_run.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// Rows that leave nothing but what a memory keeps.
class RowsOfPart final : public GridRows {
 public:
  RowsOfPart(const RunContext& context, std::span<const VariantReading> readings, unsigned threads)
      : context_(context), readings_(readings), threads_(threads)
  {
  }

  const VariantReading& variant(std::size_t row) const override { return readings_[row]; }

  EnterRow solve(std::size_t row, const Experiment& experiment) override
  {
    RowMemory memory(context_, row);
    solve_variant(prepare_variant(experiment), threads_, memory.get());
    return interrupted() ? EnterRow() : [] { return std::size_t{1}; };
  }

  EnterRow refuse(std::size_t /*row*/, RowStatus /*status*/, const std::string& /*message*/) override
  {
    return [] { return std::size_t{1}; };
  }

 private:
  const RunContext& context_;
  std::span<const VariantReading> readings_;
  unsigned threads_;
};

}  // namespace

RowMemory::RowMemory(const RunContext& context, std::size_t row)
{
  if (context.memory != nullptr) memory_.emplace(*context.memory, fmt::format("row {}: ", row));
}

void run_rows_of_part(RunContext& context, const std::string& name, std::span<const VariantReading> readings,
                      const Share& share)
{
  std::vector<std::size_t> own;
  for (std::size_t row = 0; row < readings.size(); ++row)
    if (share.has(row)) own.push_back(row);
  const std::size_t each = std::max<std::size_t>(1, context.threads / std::max<std::size_t>(1, own.size()));
  RowsOfPart rows(context, readings, static_cast<unsigned>(each));
  Grid(context, name, own.size()).run(rows, own, context.threads);
}

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
