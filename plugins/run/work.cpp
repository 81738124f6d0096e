#include "run/work.hpp"

#include "run/machine.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace hauberk {
namespace {

constexpr double megabyte = 1e6, number_bytes = 8.0;

}  // namespace

Work work_of(const Plan& plan, double searches)
{
  double pairs = 0.0;
  for (const PairPlan& kind : plan.pairs) pairs += kind.pairs;
  const double stages = static_cast<double>(std::max<std::size_t>(1, plan.stages.size()));
  const double rotations = 9.0 * plan.elements;
  const double state = number_bytes * (static_cast<double>(plan.unknowns) + rotations);
  const double hessian =
      number_bytes * (plan.sparse ? 36.0 * pairs : static_cast<double>(plan.unknowns) * plan.unknowns);
  return {searches, searches * stages * std::max(1.0, pairs), searches * (stages + 1.0) * state + hessian};
}

std::string text_of(const Work& work)
{
  return fmt::format("{:.4g} searches, at least {:.2g} evaluations of closest points and {:.3g} MB of memory",
                     work.searches, work.evaluations, work.bytes / megabyte);
}

void refuse_beyond(const Budget& budget, const Work& work)
{
  const double bytes = budget.bytes > 0.0 ? budget.bytes : available_memory();
  if (work.evaluations <= budget.evaluations && work.bytes <= bytes) return;
  throw InputError(fmt::format(
      "the run would take {}; the budget is {:.2g} evaluations and {:.3g} MB (--budget, --budget-bytes); ask for "
      "less, or go on with --yes",
      text_of(work), budget.evaluations, bytes / megabyte));
}

}  // namespace hauberk
