#include "tasks/stability/stability_run.hpp"
#include "run/interrupt.hpp"
#include "run/limit_tasks.hpp"
#include "run/variant_run.hpp"

#include <hauberk/error.hpp>
#include <hauberk/parallel.hpp>
#include "document/json_writer.hpp"
#include "tasks/stability/classify.hpp"
#include "tasks/stability/independent_check.hpp"

#include <algorithm>
#include <mutex>

namespace hauberk {
namespace {

/// Where the cases of an item stand in the map.
struct Range {
  std::size_t begin = 0, count = 0;
};

std::vector<Range> ranges(const std::vector<StabilityItem>& items)
{
  std::vector<Range> out;
  std::size_t begin = 0;
  for (const StabilityItem& item : items) {
    const std::size_t count = item.experiment ? profile_tasks(*item.experiment).size() : 1;
    out.push_back({begin, count});
    begin += count;
  }
  return out;
}

void refuse(std::vector<StabilityCase>& cases, const char* status, const std::string& message)
{
  for (StabilityCase& c : cases) {
    c.status = status;
    c.message = message;
  }
}

void solve(const StabilityItem& item, std::vector<StabilityCase>& cases)
{
  if (!item.experiment) return refuse(cases, "refused", item.refusal);
  const Experiment& e = *item.experiment;
  RunResult run;
  try {
    run = run_variant(e);
  } catch (const InputError& error) {
    return refuse(cases, "refused", error.what());
  }
  const std::vector<VerifyLine> lines =
      independent_check(run, write_json(e.resolved), macro_names(*e.load_case));
  for (std::size_t k = 0; k < cases.size(); ++k) enter_claim(cases[k], run.limits[k], lines[k]);
}

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
    if (!item.experiment) {
      map.cases.push_back(c);
      continue;
    }
    for (const LimitTask& task : profile_tasks(*item.experiment)) {
      c.direction = task.direction;
      c.upward = task.sense == Sense::positive;
      c.sense = item.experiment->load_case->sense_name(task.direction, task.sense);
      map.cases.push_back(c);
    }
  }
  return map;
}

void run_stability(const std::vector<StabilityItem>& items, unsigned threads, Progress& progress,
                   StabilityMap& map, const MapObserver& observer)
{
  const std::vector<Range> places = ranges(items);
  const auto at = [&](std::size_t item) {
    return map.cases.begin() + static_cast<std::ptrdiff_t>(places[item].begin);
  };
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const bool done = std::none_of(at(k), at(k) + static_cast<std::ptrdiff_t>(places[k].count),
                                   [](const StabilityCase& c) { return c.outcome == Outcome::interrupted; });
    if (!done) left.push_back(k);
  }
  std::mutex mutex;  // guards map, progress and observer
  std::size_t done = 0;
  progress.limits("stability", 0, left.size());
  parallel_for(left.size(), threads, [&](std::size_t i) {
    if (interrupted()) return;
    const std::size_t k = left[i];
    std::vector<StabilityCase> cases;
    {
      const std::lock_guard lock(mutex);
      cases.assign(at(k), at(k) + static_cast<std::ptrdiff_t>(places[k].count));
    }
    try {
      solve(items[k], cases);
    } catch (const std::exception& error) {
      refuse(cases, "failed", error.what());
    }
    const std::lock_guard lock(mutex);
    std::copy(cases.begin(), cases.end(), at(k));
    classify(map);
    progress.limits("stability", ++done, left.size());
    observer(map);
  });
  classify(map);
}

}  // namespace hauberk
