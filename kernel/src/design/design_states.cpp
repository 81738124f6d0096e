/// Where the states of designs come from: continued from the iterate, or looked for from rest; and which
/// designs are accepted on their strength.

#include <hauberk/design/design_problem.hpp>
#include <hauberk/error.hpp>

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

/// Accepted designs in a row with states that were only continued: then they are looked for from rest.
constexpr int most_unchecked = 4;

}  // namespace

void DesignProblem::find_targets(const std::shared_ptr<DesignPoint>& p)
{
  tried_.push_back(p);
  long cost = 0;
  if (memory_ != nullptr && memory_->recall(*p, cost)) {
    evaluations_ += cost;
    p->states_missing = p->evaluated;
  } else {
    // A start is the iterate before it is accepted.
    if (current_->states_missing) find_states(*current_);
    const long before = evaluations_;
    solve_targets(*p, *current_);
    if (memory_ != nullptr) memory_->record(*p, evaluations_ - before);
  }
  p->unchecked = p->continued ? current_->unchecked + 1 : 0;
}

void DesignProblem::find_states(DesignPoint& p)
{
  const long before = evaluations_;
  // The iterate itself has the states that it was checked from.
  if (!p.checked || &p != current_.get()) solve_targets(p, *current_);
  if (p.checked) search_again(p);
  evaluations_ = before;
  p.states_missing = false;
}

void DesignProblem::check(DesignPoint& p)
{
  long cost = 0;
  if (memory_ != nullptr && memory_->recall(p, cost)) {
    evaluations_ += cost;
    p.states_missing = true;
  } else {
    if (p.states_missing) find_states(p);
    const long before = evaluations_;
    search_again(p);
    if (memory_ != nullptr) memory_->record(p, evaluations_ - before);
  }
  p.states_kept = false;
  p.checked = true;
  if (!p.continued) p.unchecked = 0;  // else rest leads to no state that could be computed
}

void DesignProblem::search_again(DesignPoint& p)
{
  DesignPoint again = p;
  solve_targets(again, p);
  if (again.evaluated) p = std::move(again);
}

void DesignProblem::accept(std::span<const double> x)
{
  const std::shared_ptr<DesignPoint> p = make_point(x);
  if (!p->evaluated)
    throw PluginError("the optimizer accepted a design that it " + (p->why.empty()
                                                                        ? "did not evaluate from its iterate"
                                                                        : "could not evaluate: " + p->why));
  // What ends a search has to be what its limits are recomputed as.
  const bool at_the_goal = meets_targets(design_, p->values);
  p->thorough = at_the_goal;
  take(p, p->unchecked >= most_unchecked || at_the_goal);
}

void DesignProblem::take(const std::shared_ptr<DesignPoint>& p, bool look_from_rest)
{
  if (look_from_rest) check(*p);
  const bool recalled = p->states_missing && memory_->recall_states(*p);
  if (p->states_missing && !recalled) find_states(*p);
  if (memory_ != nullptr && !p->states_kept && !recalled) memory_->record_states(*p);
  p->states_missing = false;
  p->states_kept = memory_ != nullptr;
  tried_.clear();  // from the former iterate; from this one they may come out otherwise
  current_ = last_ = p;
  accepted_.push_back(p);
  if (p->unchecked > 0 || (confirmed_ && confirmed_->objective <= p->objective)) return;
  std::vector<double> room(static_cast<std::size_t>(constraint_count()));
  constraints(p->x, room, {});
  if (room.empty() || *std::min_element(room.begin(), room.end()) >= -negligible_violation) confirmed_ = p;
}

bool DesignProblem::settle()
{
  if (current_->unchecked > 0) take(current_, true);
  if (!confirmed_ || confirmed_->objective >= current_->objective) return false;
  take(confirmed_, false);
  return true;
}

}  // namespace hauberk
