/// compute_limits: all searches of all limits, in the order of their phases (limits.hpp).

#include "limits/confidence.hpp"
#include "limits/donors.hpp"
#include "limits/learning.hpp"
#include "limits/limit_report.hpp"
#include "limits/scenes_within.hpp"
#include "limits/task_searches.hpp"
#include "numerics/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
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
        within_(model, spec, tasks_, asked_, settings_, observer),
        count_(observer, mutex_)
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
    std::size_t starts = 0;
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
      starts += searches_.of(k).starts.size();
      ++unfinished_;
      if (k < asked_) ++unfinished_asked_;
    }
    threads = thread_count(threads);
    count_.expect(starts);
    if (unfinished_asked_ < asked_ && unfinished_asked_ > 0) tell();
    solve_from_rest(false, threads);
    if (!complete) solve_from_rest(true, threads);
    if (unfinished_ == 0 && !complete) {
      const Donors donors(model_, tasks_);
      if (settings_.lessons) {
        Learning learning(model_, searches_, within_, observer_, count_, results_);
        learning.run(
            donors, [this] { return is_enough(); }, unreported_, threads);
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
    count_.expect(items.size());
    parallel_for(items.size(), threads, [&](std::size_t i) {
      if (!going()) return;
      items[i]();
      count_.one_is_done();
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
    count_.one_is_done();
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
  std::mutex mutex_;                                   ///< guards all below
  std::size_t unfinished_ = 0, unfinished_asked_ = 0;  ///< tasks
  SearchCount count_;                                  ///< what observers see of it
  bool ended_ = false;                                 ///< nothing more will be learnt
  std::vector<LimitResult> results_;
  std::vector<LimitResult> unreported_;  ///< of scenes that this one contains
};

}  // namespace

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
