#include "tasks/stability/stability_run.hpp"

#include "document/json_writer.hpp"
#include "run/limit_tasks.hpp"
#include "run/variant_run.hpp"
#include "tasks/stability/classify.hpp"
#include "tasks/stability/independent_check.hpp"
#include "tasks/variants/grid.hpp"

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

/// The items of a map, each a row of one case or several that follow each other in it.
class StabilityRows final : public GridRows {
 public:
  StabilityRows(const std::vector<StabilityItem>& items, StabilityMap& map, const RunContext& context)
      : items_(items), map_(map), context_(context)
  {
    begin_.push_back(0);
    for (const StabilityItem& item : items) {
      const auto& e = item.reading.experiment;
      begin_.push_back(begin_.back() + (e ? profile_tasks(*e).size() : 1));
    }
    for (std::size_t k = 0; k < items.size(); ++k) asked_.push_back(cases_of(k));
  }

  /// Items with cases that are not done.
  std::vector<std::size_t> left() const
  {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < items_.size(); ++k) {
      if (std::any_of(asked_[k].begin(), asked_[k].end(),
                      [](const StabilityCase& c) { return c.outcome == Outcome::interrupted; }))
        out.push_back(k);
    }
    return out;
  }

  const VariantReading& variant(std::size_t row) const override { return items_[row].reading; }

  EnterRow solve(std::size_t row, const Experiment& e) override
  {
    RowMemory memory(context_, row);
    const RunResult run = run_variant(e, memory.get());
    if (std::all_of(run.limits.begin(), run.limits.end(),
                    [](const LimitResult& limit) { return limit.status == LimitStatus::interrupted; }))
      return {};
    const std::vector<VerifyLine> lines =
        independent_check(run, write_json(e.resolved), macro_names(*e.load_case));
    return entry(row, [&](StabilityCase& c, std::size_t k) { enter_claim(c, run.limits[k], lines[k]); });
  }

  EnterRow refuse(std::size_t row, RowStatus status, const std::string& message) override
  {
    return entry(row, [&](StabilityCase& c, std::size_t /*k*/) {
      c.status = to_string(status);
      c.message = message;
    });
  }

 private:
  std::vector<StabilityCase> cases_of(std::size_t row) const
  {
    const auto at = [&](std::size_t k) {
      return map_.cases.begin() + static_cast<std::ptrdiff_t>(begin_[k]);
    };
    return {at(row), at(row + 1)};
  }

  /// An item's cases as `fill` completes them. What a case was asked for never changes.
  template <class Fill>
  EnterRow entry(std::size_t row, const Fill& fill)
  {
    std::vector<StabilityCase> cases = asked_[row];
    for (std::size_t k = 0; k < cases.size(); ++k) fill(cases[k], k);
    return [this, row, cases = std::move(cases)]() -> std::size_t {
      std::copy(cases.begin(), cases.end(), map_.cases.begin() + static_cast<std::ptrdiff_t>(begin_[row]));
      classify(map_);
      return 1;
    };
  }

  const std::vector<StabilityItem>& items_;
  StabilityMap& map_;
  const RunContext& context_;
  std::vector<std::size_t> begin_;                 ///< of each item's cases, and one past the end
  std::vector<std::vector<StabilityCase>> asked_;  ///< by item, as they were at first
};

}  // namespace

StabilityMap empty_map(const ExperimentStability& from, const std::vector<StabilityItem>& items)
{
  StabilityMap map;
  map.tolerance = from.tolerance;
  for (const StabilityMethod& method : from.methods) map.methods.push_back(method.name);
  for (const StabilityFamily& family : from.families)
    map.families.push_back({family.name, family.why, family.labels, family.solvable});
  for (const StabilityItem& item : items) {
    StabilityCase c;
    c.family = item.family;
    c.member = item.member;
    c.method = item.method;
    c.scene = item.scene;
    c.solvable = from.families[item.family].solvable;
    c.exact = from.families[item.family].exact[item.member];
    if (!item.reading.experiment) {
      map.cases.push_back(c);
      continue;
    }
    for (const LimitTask& task : profile_tasks(*item.reading.experiment)) {
      c.direction = task.direction;
      c.upward = task.sense == Sense::positive;
      c.sense = item.reading.experiment->load_case->sense_name(task.direction, task.sense);
      map.cases.push_back(c);
    }
  }
  return map;
}

void run_stability(const std::vector<StabilityItem>& items, RunContext& context, StabilityMap& map)
{
  StabilityRows rows(items, map, context);
  const std::vector<std::size_t> left = rows.left();
  Grid(context, "stability", left.size()).run(rows, left, context.threads);
  classify(map);
}

}  // namespace hauberk
