#include "design/journal.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace hauberk {

bool DesignJournal::recall(DesignPoint& p, long& cost) const
{
  if (memory_ == nullptr || !memory_->recall(p, cost)) return false;
  const bool fits = !p.evaluated || (p.values.size() == scene_->design.targets.size() &&
                                     p.gradient.size() == static_cast<Eigen::Index>(p.x.size()));
  const bool known = std::all_of(p.changed.begin(), p.changed.end(), [this](int task) {
    return task >= 0 && static_cast<std::size_t>(task) < search_.task_count();
  });
  if (!fits || !known)
    throw ComputationError(
        "what is remembered of an evaluation is of another design; start anew with --force");
  return true;
}

void DesignJournal::evaluate(const std::vector<std::shared_ptr<DesignPoint>>& points, DesignPoint& iterate)
{
  std::vector<long> cost(points.size(), 0);
  std::size_t known = 0;
  while (known < points.size() && recall(*points[known], cost[known])) {
    points[known]->states_missing = points[known]->evaluated;
    ++known;
  }
  if (known < points.size()) {
    // A start is the iterate before it is accepted.
    if (iterate.states_missing) find_states(iterate, iterate);
    const std::size_t open = points.size() - known;
    const unsigned threads = search_.threads();
    const auto count = static_cast<unsigned>(open);
    const unsigned each = (threads + count - 1) / count;  // for the directions of a point
    parallel_for(open, threads,
                 [&](std::size_t i) { cost[known + i] = search_.solve(*points[known + i], iterate, each); });
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (memory_ != nullptr && i >= known) memory_->record(*points[i], cost[i]);
    evaluations_ += cost[i];
    points[i]->unchecked = points[i]->continued ? iterate.unchecked + 1 : 0;
  }
}

void DesignJournal::find_states(DesignPoint& p, const DesignPoint& iterate)
{
  // The iterate itself has the states that it was checked from.
  if (!p.checked || &p != &iterate) search_.solve(p, iterate, search_.threads());
  if (p.checked) search_again(p);
  p.states_missing = false;
}

void DesignJournal::check(DesignPoint& p, const DesignPoint& iterate)
{
  long cost = 0;
  if (recall(p, cost)) {
    p.states_missing = true;
  } else {
    if (p.states_missing) find_states(p, iterate);
    cost = search_again(p);
    if (memory_ != nullptr) memory_->record(p, cost);
  }
  evaluations_ += cost;
  p.states_kept = false;
  p.checked = true;
  if (!p.continued) p.unchecked = 0;  // else rest leads to no state that could be computed
}

long DesignJournal::search_again(DesignPoint& p) const
{
  const Look look = p.look;
  long cost = 0;
  const auto solve = [&](Look with) {
    DesignPoint again = p;
    again.look = with;
    cost += search_.solve(again, p, search_.threads());
    const bool evaluated = again.evaluated;
    if (evaluated) p = std::move(again);
    return evaluated;
  };
  if (look != Look::quick_then_whole) {
    solve(look);
    return cost;
  }
  std::set<int> changed;
  bool evaluated = false;
  for (const Look with : {Look::quick, Look::until_exceeded, Look::whole}) {
    // Values of a report and of the search differ by what their stages leave: one may exceed a target that
    // the other meets.
    if (with == Look::whole && !p.looked_in_part) break;
    if (!solve(with)) continue;
    evaluated = true;
    changed.insert(p.changed.begin(), p.changed.end());
    if (!meets_targets(scene_->design, p.values)) break;
  }
  if (evaluated) p.changed.assign(changed.begin(), changed.end());
  p.look = look;
  return cost;
}

void DesignJournal::keep_states(DesignPoint& p, const DesignPoint& iterate)
{
  const bool recalled = p.states_missing && memory_->recall_states(p);
  if (p.states_missing && !recalled) find_states(p, iterate);
  if (memory_ != nullptr && !p.states_kept && !recalled) memory_->record_states(p);
  p.states_missing = false;
  p.states_kept = memory_ != nullptr;
}

}  // namespace hauberk
