#include "design/journal.hpp"

#include <utility>

namespace hauberk {

void DesignJournal::evaluate(DesignPoint& p, DesignPoint& iterate)
{
  long cost = 0;
  if (memory_ != nullptr && memory_->recall(p, cost)) {
    p.states_missing = p.evaluated;
  } else {
    // A start is the iterate before it is accepted.
    if (iterate.states_missing) find_states(iterate, iterate);
    cost = search_.solve(p, iterate);
    if (memory_ != nullptr) memory_->record(p, cost);
  }
  evaluations_ += cost;
  p.unchecked = p.continued ? iterate.unchecked + 1 : 0;
}

void DesignJournal::find_states(DesignPoint& p, const DesignPoint& iterate)
{
  // The iterate itself has the states that it was checked from.
  if (!p.checked || &p != &iterate) search_.solve(p, iterate);
  if (p.checked) search_again(p);
  p.states_missing = false;
}

void DesignJournal::check(DesignPoint& p, const DesignPoint& iterate)
{
  long cost = 0;
  if (memory_ != nullptr && memory_->recall(p, cost)) {
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
  DesignPoint again = p;
  const long cost = search_.solve(again, p);
  if (again.evaluated) p = std::move(again);
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
