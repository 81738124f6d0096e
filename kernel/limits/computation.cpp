#include "limits/confidence.hpp"
#include "limits/donors.hpp"
#include "limits/further_searches.hpp"
#include "limits/limit_report.hpp"
#include "limits/scenes_within.hpp"
#include "limits/task_searches.hpp"
#include "numerics/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

namespace hauberk {
namespace {

class Computation {
 public:
  Computation(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& tasks,
              const LimitSettings& settings, const LimitsObserver& observer)
      : model_(model),
        searches_(model, spec, tasks, settings, observer),
        tasks_(searches_.tasks()),
        asked_(tasks.size()),
        settings_(searches_.settings()),
        observer_(observer),
        within_(model, spec, tasks_, asked_, settings_, observer)
  {
    for (const LimitTask& task : tasks_) {
      results_.push_back(limit_header(model, task));
      results_.back().status = LimitStatus::interrupted;
    }
  }

  std::vector<LimitResult> run(unsigned threads, const std::vector<std::optional<LimitResult>>& known)
  {
    const bool complete =
        known.size() == asked_ && std::all_of(known.begin(), known.end(), [](const auto& r) {
          return r.has_value() && r->confidence.is_final();
        });
    ended_ = complete;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      // What was learnt from other limits is learnt again unless all is known: then nothing depends on
      // where a run was interrupted.
      std::optional<LimitResult> there;
      if (k < known.size() && known[k] && known[k]->confidence.word != "unfinished") there = known[k];
      if (there && there->status != LimitStatus::locked) there->confidence.word = "none";
      if (there || (complete && k >= asked_)) {
        if (there) results_[k] = std::move(*there);
        searches_.of(k).known = true;
        searches_.of(k).missing = 0;
        continue;
      }
      total_ += searches_.of(k).starts.size();
      ++unfinished_;
      if (k < asked_) ++unfinished_asked_;
    }
    threads = thread_count(threads);
    if (observer_.on_start) observer_.on_start(0, total_);
    if (unfinished_asked_ < asked_ && unfinished_asked_ > 0) tell();
    solve_from_rest(false, threads);
    if (!complete) solve_from_rest(true, threads);
    if (unfinished_ == 0 && !complete) {
      const Donors donors(model_, tasks_);
      FurtherSearches further(model_, searches_);
      if (settings_.lessons && !is_enough()) {
        search_on(further, threads);
        if (!is_enough() && inherit(donors, threads)) learn(donors, further, threads);
      }
      if (going()) enter_relations(results_, model_, settings_, tasks_, donors);
      ended_ = going();
    }
    keep_unfinished();
    tell();
    if (observer_.on_unreported) {
      unreported_.insert(unreported_.end(), results_.begin() + static_cast<std::ptrdiff_t>(asked_),
                         results_.end());
      observer_.on_unreported(unreported_);
    }
    if (observer_.on_states) {
      std::vector<std::optional<State>> states(asked_);
      for (std::size_t k = 0; k < asked_; ++k)
        if (std::optional<FoundState> best = searches_.furthest_of(k))
          states[k] = std::move(best->locked.state);
      observer_.on_states(states);
    }
    return so_far();
  }

  /// A share of the searches that stand alone, for the memory. Returns how many all of them are; null:
  /// interrupted.
  std::optional<std::size_t> search(unsigned threads, const Share& share)
  {
    std::vector<std::function<void()>> items;
    std::size_t count = 0;
    const auto add = [&](auto item) {
      if (share.has(count++)) items.emplace_back(std::move(item));
    };
    bool sparing = false;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      const std::size_t before = items.size();
      for (std::size_t s = 0; s < searches_.of(k).starts.size(); ++s)
        add([this, k, s] { searches_.attempt(k, s); });
      for (int t = 0; k < asked_ && t < settings_.tilts; ++t)
        add([this, k, t] {
          double seconds = 0.0;
          try {
            searches_.tilted_search(k, t, seconds);
          } catch (const std::exception&) {  // it throws again where it is asked for
          }
        });
      sparing |= searches_.of(k).is_sparing(searches_.of(k).starts.size() - 1) && items.size() > before;
    }
    threads = thread_count(threads);
    if (sparing) searches_.find_allowance(threads);
    searches_.share_out(threads, items.size());
    total_ = items.size();
    if (observer_.on_start) observer_.on_start(0, total_);
    parallel_for(items.size(), threads, [&](std::size_t i) {
      if (!going()) return;
      items[i]();
      const std::lock_guard lock(mutex_);
      ++done_;
      if (observer_.on_start) observer_.on_start(done_, total_);
    });
    if (settings_.lessons) count += within_.search(threads, share.after(count));
    return going() ? std::optional(count) : std::nullopt;
  }

 private:
  /// Starts of the tasks that are not known yet: those that are sparing, or the others.
  void solve_from_rest(bool sparing, unsigned threads)
  {
    std::vector<std::pair<std::size_t, std::size_t>> items;  // task, start
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      if (searches_.of(k).known) continue;
      for (std::size_t s = 0; s < searches_.of(k).starts.size(); ++s)
        if (searches_.of(k).is_sparing(s) == sparing) items.emplace_back(k, s);
    }
    if (items.empty() || !going()) return;
    if (sparing) searches_.find_allowance(threads);
    searches_.share_out(threads, items.size());
    parallel_for(items.size(), threads, [&](std::size_t i) {
      if (going()) solve(items[i].first, items[i].second);
    });
  }

  /// Results of the limits asked for, as far as they are.
  std::vector<LimitResult> so_far() const
  {
    std::vector<LimitResult> out(results_.begin(), results_.begin() + static_cast<std::ptrdiff_t>(asked_));
    for (std::size_t k = 0; k < asked_ && !ended_; ++k) {
      out[k].confidence.word = searches_.of(k).learning ? "unfinished" : "alone";
    }
    return out;
  }

  bool is_enough() const { return observer_.is_enough && observer_.is_enough(so_far()); }

  void tell() const
  {
    if (observer_.on_limit) observer_.on_limit(so_far());
  }

  void solve(std::size_t task, std::size_t start)
  {
    Attempt done;
    {
      const std::lock_guard lock(mutex_);
      done.needless = start > 0 && searches_.runs_away(task);
    }
    if (!done.needless) done = searches_.attempt(task, start);
    const bool finished = done.locked || !done.error.empty() || done.needless;
    bool last = false;
    {
      const std::lock_guard lock(mutex_);
      searches_.of(task).starts[start] = std::move(done);
      if (!finished) return;
      last = --searches_.of(task).missing == 0;
      if (last) ++searches_.of(task).missing;  // the task itself, until its tilts are done
    }
    if (last) {
      if (!searches_.tilt(task)) return;
      // Outside the lock: forces and balances take a moment.
      LimitResult result = searches_.result_of(task, [this] { return going(); });
      if (result.status == LimitStatus::interrupted) return;
      const std::lock_guard lock(mutex_);
      searches_.of(task).missing = 0;
      results_[task] = std::move(result);
      --unfinished_;
      // The last one is told when limits have learnt from each other: who was told all has all.
      if (task < asked_ && --unfinished_asked_ > 0) tell();
    }
    const std::lock_guard lock(mutex_);
    ++done_;
    if (observer_.on_start) observer_.on_start(done_, total_);
  }

  /// The macroscopic unknowns of a result, scaled; null: it has no state.
  std::optional<Vector> macro_of(std::size_t task) const
  {
    const LimitResult& r = results_[task];
    if (static_cast<int>(r.macro.size()) != model_.macro_count) return std::nullopt;
    Vector macro(model_.macro_count);
    for (int k = 0; k < model_.macro_count; ++k) {
      const int power = model_.load->macros()[k].length_power;
      macro[k] = r.macro[k].second / std::pow(model_.length, power);
    }
    return macro;
  }

  std::optional<double> reached_by(const Donors& donors, std::size_t donor, std::size_t task) const
  {
    const std::optional<Vector> macro = macro_of(donors.task(donor));
    return macro ? donors.reached(donor, *macro, tasks_[task]) : std::nullopt;
  }

  std::string learnt_from(const Donors& donors, std::size_t donor) const
  {
    const LimitResult& r = results_[donors.task(donor)];
    return fmt::format("{}, {}{}", r.direction.text(), r.sense,
                       donors.is_own(donor) ? "" : ", by a symmetry of the scene");
  }

  /// Locked state of a task from where a donor's best state is; null where there is none, too. `further`:
  /// that one is known to be further than the task's own.
  std::optional<FoundState> taught(const Donors& donors, std::size_t task, std::size_t donor, bool further)
  {
    const std::size_t from = donors.task(donor);
    const std::optional<FoundState> best = searches_.furthest_of(from);
    if (!best) return std::nullopt;
    const std::optional<State> start = donors.state(donor, best->locked);
    if (!start) return std::nullopt;
    const std::string place = learnt_from(donors, donor);
    if (further || !is_taut(model_, tasks_[task]))
      return searches_.begun_from(task, *start, place, best->seed);
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
  void stopped(std::size_t task, const std::string& message)
  {
    results_[task].status = LimitStatus::interrupted;
    results_[task].message = message;
  }

  void stopped_before(std::size_t task, const std::string& place)
  {
    stopped(task, fmt::format("what the state of {} leads to was not found", place));
  }

  /// The same of the tasks of lessons.
  void find_states(const Donors& donors, const std::vector<Lesson>& lessons, unsigned threads)
  {
    std::vector<std::size_t> needed;
    for (const auto& [task, donor] : lessons) {
      needed.push_back(task);
      needed.push_back(donors.task(donor));
    }
    searches_.find_states(needed, threads);
  }

  /// Limits whose searches do not settle them have more.
  void search_on(FurtherSearches& further, unsigned threads)
  {
    // Results that came with the call tell whether starts agree as long as nothing else was learnt, and
    // nothing of forces, on which stretches depend.
    std::vector<std::size_t> learnt;
    for (std::size_t k = 0; k < asked_; ++k)
      if (further.may_go_on(k) && searches_.of(k).known &&
          (results_[k].confidence.is_final() || is_taut(model_, tasks_[k])))
        learnt.push_back(k);
    if (going()) searches_.find_states(learnt, threads);
    for (const std::size_t k : learnt) look_again(k);
    const std::vector<std::size_t> undecided = further.undecided(results_);
    if (going()) searches_.find_states(undecided, threads);
    const std::vector<FurtherSearch> starts = further.from_rest(undecided);
    total_ += starts.size();
    if (observer_.on_start && !starts.empty()) observer_.on_start(done_, total_);
    std::vector<Attempt> found(starts.size());
    std::vector<std::optional<FoundState>> tilted(starts.size());
    parallel_for(starts.size(), threads, [&](std::size_t i) {
      if (!going()) return;
      const FurtherSearch& s = starts[i];
      if (s.tilt > 0.0)
        tilted[i] = searches_.from_tilted_load(s.task, s.tilt, s.number);
      else
        found[i] = searches_.attempt(s.task, s.number);
      const std::lock_guard lock(mutex_);
      ++done_;
      if (observer_.on_start) observer_.on_start(done_, total_);
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
  void look_again(std::size_t task)
  {
    searches_.of(task).learning = true;
    results_[task] = searches_.result_of(task, [this] { return going(); });
  }

  /// Each limit begins once more from every state that is given for it. False: interrupted.
  bool inherit(const Donors& donors, unsigned threads)
  {
    std::vector<GivenState> given = within_.states(threads, unreported_);
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
  void in_a_round(int round, std::size_t count, unsigned threads, const Search& search)
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
  void learn(const Donors& donors, FurtherSearches& further_searches, unsigned threads)
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
        if (!refold(further_searches, round, threads)) return;
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
  bool refold(FurtherSearches& further, int round, unsigned threads)
  {
    const std::vector<std::size_t> learners = further.unfolded(results_);
    if (going()) searches_.find_states(learners, threads);
    const std::vector<FurtherSearch> loads = further.refolds(learners);
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
      if (found[i] && searches_.enter_if_further(k, std::move(*found[i]), further.refolded_from(k)))
        any = true;
    }
    for (const std::size_t k : learners) look_again(k);
    return any;
  }

  /// Starts that were done before an interrupt are worth keeping, as far as a moment suffices to report them
  /// (LimitsObserver::moment_to_report).
  void keep_unfinished()
  {
    const auto end = std::chrono::steady_clock::now() + observer_.moment_to_report;
    const KeepGoing for_a_moment = [end] { return std::chrono::steady_clock::now() < end; };
    for (std::size_t k = 0; k < asked_; ++k) keep_unfinished(k, for_a_moment);
  }

  void keep_unfinished(std::size_t task, const KeepGoing& keep_going)
  {
    const TaskState& t = searches_.of(task);
    if (t.missing == 0) return;
    const auto done = static_cast<std::size_t>(std::count_if(
        t.starts.begin(), t.starts.end(), [](const Attempt& a) { return a.locked.has_value(); }));
    if (done == 0) return;
    LimitResult result = searches_.result_of(task, keep_going);
    result.status = LimitStatus::interrupted;
    result.message = fmt::format("{} of {} starts were done", done, t.starts.size());
    results_[task] = std::move(result);
  }

  bool going() const { return searches_.going(); }

  const Model& model_;
  TaskSearches searches_;                ///< what `mutex_` guards is what tasks know that are being searched
  const std::vector<LimitTask>& tasks_;  ///< those asked for, then their company
  const std::size_t asked_;
  const LimitSettings& settings_;
  const LimitsObserver& observer_;
  ScenesWithin within_;
  std::size_t total_ = 0, done_ = 0;
  std::mutex mutex_;                                   ///< guards all below
  std::size_t unfinished_ = 0, unfinished_asked_ = 0;  ///< tasks
  bool ended_ = false;                                 ///< nothing more will be learnt
  std::vector<LimitResult> results_;
  std::vector<LimitResult> unreported_;  ///< of scenes that this one contains
};

}  // namespace

double further_than(const LimitSettings& settings) { return std::max(1e-8, settings.schedule.last); }

std::vector<LimitResult> compute_limits(const Model& model, const SceneSpec& spec,
                                        const std::vector<LimitTask>& tasks, const LimitSettings& settings,
                                        unsigned threads, const LimitsObserver& observer,
                                        const std::vector<std::optional<LimitResult>>& known)
{
  return Computation(model, spec, tasks, settings, observer).run(threads, known);
}

double count_searches(const Model& model, const std::vector<LimitTask>& tasks, const LimitSettings& settings)
{
  double count = static_cast<double>(tasks.size()) * settings.tilts;
  for (const RestSearches& searches : rest_searches(model, tasks, settings))
    count += static_cast<double>(searches.starts);
  return count;
}

std::optional<std::size_t> compute_searches(const Model& model, const SceneSpec& spec,
                                            const std::vector<LimitTask>& tasks,
                                            const LimitSettings& settings, unsigned threads,
                                            const LimitsObserver& observer, const Share& share)
{
  return Computation(model, spec, tasks, settings, observer).search(threads, share);
}

}  // namespace hauberk
