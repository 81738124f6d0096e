#include "limits/learning.hpp"

#include "numerics/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hauberk {

double further_than(const LimitSettings& settings) { return std::max(1e-8, settings.schedule.last); }

Learning::Learning(const Model& model, TaskSearches& searches, const ScenesWithin& within,
                   const LimitsObserver& observer, SearchCount& count, std::vector<LimitResult>& results)
    : model_(model),
      searches_(searches),
      within_(within),
      observer_(observer),
      count_(count),
      results_(results),
      tasks_(searches.tasks()),
      asked_(searches.asked()),
      settings_(searches.settings()),
      further_(model, searches)
{
}

void Learning::run(const Donors& donors, const std::function<bool()>& is_enough,
                   std::vector<LimitResult>& unreported, unsigned threads)
{
  if (is_enough()) return;
  search_on(threads);
  if (!is_enough() && inherit(donors, unreported, threads)) learn(donors, is_enough, threads);
}

/// The macroscopic unknowns of a result, scaled; null: it has no state.
std::optional<Vector> Learning::macro_of(std::size_t task) const
{
  const LimitResult& r = results_[task];
  if (static_cast<int>(r.macro.size()) != model_.macro_count) return std::nullopt;
  Vector macro(model_.macro_count);
  for (int k = 0; k < model_.macro_count; ++k) macro[k] = r.macro[k].second / model_.macro_unit(k);
  return macro;
}

std::optional<double> Learning::reached_by(const Donors& donors, std::size_t donor, std::size_t task) const
{
  const std::optional<Vector> macro = macro_of(donors.task(donor));
  return macro ? donors.reached(donor, *macro, tasks_[task]) : std::nullopt;
}

std::string Learning::learnt_from(const Donors& donors, std::size_t donor) const
{
  const LimitResult& r = results_[donors.task(donor)];
  return fmt::format("{}, {}{}", r.direction.text(), r.sense,
                     donors.is_own(donor) ? "" : ", by a symmetry of the scene");
}

/// Locked state of a task from where a donor's best state is; null where there is none, too. `further`:
/// that one is known to be further than the task's own.
std::optional<FoundState> Learning::taught(const Donors& donors, std::size_t task, std::size_t donor,
                                           bool further)
{
  const std::size_t from = donors.task(donor);
  const std::optional<FoundState> best = searches_.furthest_of(from);
  if (!best) return std::nullopt;
  const std::optional<State> start = donors.state(donor, best->locked);
  if (!start) return std::nullopt;
  const std::string place = learnt_from(donors, donor);
  if (further || !is_taut(model_, tasks_[task])) return searches_.begun_from(task, *start, place, best->seed);
  std::optional<FoundState> out =
      searches_.begun_from(task, *start, place, best->seed, searches_.allowance_of(task));
  // What was further when its allowance was spent is worth more.
  if (out && searches_.gave_up_further(task, *out)) {
    const Locked first = std::move(out->locked);
    out = searches_.begun_from(task, *start, place, best->seed);
    if (out) {
      out->locked.iterations += first.iterations;
      out->locked.evaluations += first.evaluations;
    }
  }
  return out;
}

/// A limit that was stopped among what follows its starts is no answer: a run that goes on has to ask
/// again.
void Learning::stopped(std::size_t task, const std::string& message)
{
  results_[task].status = LimitStatus::interrupted;
  results_[task].message = message;
}

void Learning::stopped_before(std::size_t task, const std::string& place)
{
  stopped(task, fmt::format("what the state of {} leads to was not found", place));
}

/// The same of the tasks of lessons.
void Learning::find_states(const Donors& donors, const std::vector<Lesson>& lessons, unsigned threads)
{
  std::vector<std::size_t> needed;
  for (const auto& [task, donor] : lessons) {
    needed.push_back(task);
    needed.push_back(donors.task(donor));
  }
  searches_.find_states(needed, threads);
}

/// Limits whose searches do not settle them have more.
void Learning::search_on(unsigned threads)
{
  // Results that came with the call tell whether starts agree as long as nothing else was learnt, and
  // nothing of forces, on which stretches depend.
  std::vector<std::size_t> learnt;
  for (std::size_t k = 0; k < asked_; ++k)
    if (further_.may_go_on(k) && searches_.of(k).known &&
        (results_[k].confidence.is_final() || is_taut(model_, tasks_[k])))
      learnt.push_back(k);
  if (going()) searches_.find_states(learnt, threads);
  for (const std::size_t k : learnt) look_again(k);
  const std::vector<std::size_t> undecided = further_.undecided(results_);
  if (going()) searches_.find_states(undecided, threads);
  const std::vector<FurtherSearch> starts = further_.from_rest(undecided);
  if (!starts.empty()) count_.expect(starts.size());
  std::vector<Attempt> found(starts.size());
  std::vector<std::optional<FoundState>> tilted(starts.size());
  parallel_for(starts.size(), threads, [&](std::size_t i) {
    if (!going()) return;
    const FurtherSearch& s = starts[i];
    if (s.tilt > 0.0)
      tilted[i] = searches_.from_tilted_load(s.task, s.tilt, s.number);
    else
      found[i] = searches_.attempt(s.task, s.number);
    count_.one_is_done();
  });
  if (!going()) {
    for (const std::size_t k : undecided) stopped(k, "searches beyond the first were not done");
    return;
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (tilted[i])
      searches_.of(starts[i].task).further.push_back(std::move(*tilted[i]));
    else if (!(starts[i].tilt > 0.0))
      searches_.enter(starts[i].task, starts[i].number, found[i]);
  }
  for (const std::size_t k : undecided) look_again(k);
}

/// The result of a task that has found more than its starts.
void Learning::look_again(std::size_t task)
{
  searches_.of(task).learning = true;
  results_[task] = searches_.result_of(task, [this] { return going(); });
}

/// Each limit begins once more from every state that is given for it. False: interrupted.
bool Learning::inherit(const Donors& donors, std::vector<LimitResult>& unreported, unsigned threads)
{
  std::vector<GivenState> given = within_.states(threads, unreported);
  given.insert(given.begin(), settings_.given.begin(), settings_.given.end());
  std::vector<std::pair<std::size_t, const GivenState*>> items;
  std::vector<Lesson> learners;
  for (std::size_t k = 0; k < asked_; ++k) {
    for (const GivenState& g : given) {
      if (g.sense != tasks_[k].sense || g.direction != tasks_[k].direction) continue;
      items.emplace_back(k, &g);
      learners.push_back({k, donors.own(k)});
    }
  }
  if (going()) find_states(donors, learners, threads);
  std::vector<std::optional<FoundState>> found(items.size());
  parallel_for(items.size(), threads, [&](std::size_t i) {
    const auto& [k, from] = items[i];
    if (going()) {
      const std::optional<long> allowed = searches_.allowance_from(k, from->state);
      found[i] = searches_.begun_from(k, from->state, from->origin, settings_.seed, allowed);
    }
  });
  if (!going()) {
    // Also where scenes were not solved that would have given a state.
    for (std::size_t k = 0; k < asked_; ++k)
      if (within_.inherits(k)) stopped_before(k, "a scene that this one contains");
    for (const auto& [k, from] : items) stopped_before(k, from->origin);
    return false;
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::size_t k = items[i].first;
    if (found[i]) searches_.of(k).further.push_back(std::move(*found[i]));
    look_again(k);
  }
  return true;
}

/// Searches that begin from locked states, which is told as they are done.
template <class Search>
void Learning::in_a_round(int round, std::size_t count, unsigned threads, const Search& search)
{
  std::size_t done = 0;
  if (observer_.on_lesson && count > 0) observer_.on_lesson(round, done, count);
  parallel_for(count, threads, [&](std::size_t i) {
    if (going()) search(i);
    const std::lock_guard lock(mutex_);
    ++done;
    if (observer_.on_lesson) observer_.on_lesson(round, done, count);
  });
}

/// Limits learn from each other: rounds in which each begins once more from the furthest state that any
/// other, or a symmetric image of one, has for it; where nothing further is known, from the states of the
/// loads beside its own, as long as these come to new ones.
void Learning::learn(const Donors& donors, const std::function<bool()>& is_enough, unsigned threads)
{
  Lessons rounds(asked_, donors.count(), further_than(settings_));
  Walks walks(donors.starting_points(asked_, settings_.contact));
  const auto own = [&](std::size_t k) -> std::optional<double> {
    const LimitStatus status = results_[k].status;
    const std::size_t self = donors.own(k);
    if (status == LimitStatus::locked) return reached_by(donors, self, k);
    // One that stalled learns also from a state that is only as far as its own.
    const auto there = status == LimitStatus::stalled ? reached_by(donors, self, k) : std::nullopt;
    return there ? std::optional(*there - 2.0 * further_than(settings_)) : std::nullopt;
  };
  const auto given = [&](std::size_t donor, std::size_t k) {
    return results_[donors.task(donor)].status == LimitStatus::locked ? reached_by(donors, donor, k)
                                                                      : std::nullopt;
  };
  for (int round = 1; !is_enough(); ++round) {
    std::vector<Lesson> lessons = rounds.next(own, given);
    const bool further = !lessons.empty();
    if (!further) {
      lessons = walks.next(
          [&](std::size_t donor) {
            const std::size_t k = donors.task(donor);
            return given(donors.own(k), k);
          },
          further_than(settings_));
    }
    if (lessons.empty()) {
      if (!refold(round, threads)) return;
      continue;
    }
    find_states(donors, lessons, threads);
    std::vector<std::optional<FoundState>> found(lessons.size());
    in_a_round(round, lessons.size(), threads, [&](std::size_t i) {
      found[i] = taught(donors, lessons[i].learner, lessons[i].donor, further);
    });
    if (!going()) {
      for (const auto& [task, donor] : lessons) stopped_before(task, learnt_from(donors, donor));
      return;
    }
    for (std::size_t i = 0; i < lessons.size(); ++i) {
      const std::size_t task = lessons[i].learner;
      if (found[i]) searches_.of(task).further.push_back(std::move(*found[i]));
      look_again(task);
    }
  }
}

/// Limits are folded again by random loads from their furthest states. Returns whether any came further, so
/// that others may learn from it and it is folded again from there.
bool Learning::refold(int round, unsigned threads)
{
  const std::vector<std::size_t> learners = further_.unfolded(results_);
  if (going()) searches_.find_states(learners, threads);
  const std::vector<FurtherSearch> loads = further_.refolds(learners);
  std::vector<std::optional<FoundState>> found(loads.size());
  in_a_round(round, loads.size(), threads, [&](std::size_t i) {
    found[i] = searches_.refolded(loads[i].task, *loads[i].from, loads[i].number);
  });
  if (!going()) {
    for (const std::size_t k : learners)
      stopped(k, "what random loads from its furthest state lead to was not found");
    return false;
  }
  bool any = false;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::size_t k = loads[i].task;
    if (found[i] && searches_.enter_if_further(k, std::move(*found[i]), further_.refolded_from(k)))
      any = true;
  }
  for (const std::size_t k : learners) look_again(k);
  return any;
}

}  // namespace hauberk
