#include "limit_report.hpp"

#include <hauberk/parallel.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

namespace hauberk {
namespace {

/// One start of one task.
struct Attempt {
  std::optional<Locked> locked;  ///< null: not begun, interrupted, or it threw
  std::string error;
  double seconds = 0.0;
};

class Computation {
 public:
  Computation(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& tasks,
              const LimitSettings& settings, const LimitsObserver& observer)
      : model_(model),
        spec_(spec),
        tasks_(tasks),
        settings_(settings),
        observer_(observer),
        starts_(static_cast<std::size_t>(std::max(1, settings.starts))),
        attempts_(tasks.size() * starts_),
        missing_(tasks.size(), starts_)
  {
    for (const LimitTask& task : tasks) {
      results_.push_back(limit_header(model, task));
      results_.back().status = LimitStatus::interrupted;
    }
  }

  std::vector<LimitResult> run(unsigned threads, const std::vector<std::optional<LimitResult>>& known)
  {
    std::vector<std::size_t> items;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      if (k < known.size() && known[k]) {
        finish(k, *known[k]);
      } else if (std::optional<LimitResult> decided = decided_by_links(model_, tasks_[k])) {
        finish(k, std::move(*decided));
      } else {
        for (std::size_t s = 0; s < starts_; ++s) items.push_back(k * starts_ + s);
      }
    }
    total_ = items.size();
    if (observer_.on_start) observer_.on_start(0, total_);
    parallel_for(items.size(), threads, [&](std::size_t i) {
      if (going()) solve(items[i]);
    });
    for (std::size_t k = 0; k < tasks_.size(); ++k) keep_unfinished(k);
    return std::move(results_);
  }

 private:
  bool going() const { return !observer_.keep_going || observer_.keep_going(); }

  void solve(std::size_t item)
  {
    const std::size_t task = item / starts_;
    Attempt attempt;
    const auto t0 = std::chrono::steady_clock::now();
    try {
      attempt.locked = limit_from_start(model_, tasks_[task], settings_, static_cast<int>(item % starts_),
                                        [this] { return going(); });
    } catch (const std::exception& error) {
      attempt.error = error.what();
    }
    attempt.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    if (attempt.locked && attempt.locked->status == LockStatus::interrupted) attempt.locked.reset();
    const bool finished = attempt.locked || !attempt.error.empty();

    bool last = false;
    {
      const std::lock_guard lock(mutex_);
      attempts_[item] = std::move(attempt);
      if (!finished) return;
      last = --missing_[task] == 0;
    }
    if (last) {
      LimitResult result = result_of(task);  // outside the lock: forces and balances take a moment
      const std::lock_guard lock(mutex_);
      finish(task, std::move(result));
    }
    const std::lock_guard lock(mutex_);
    ++done_;
    if (observer_.on_start) observer_.on_start(done_, total_);
  }

  /// Out of the starts that there are. Only called when no other thread works on this task.
  LimitResult result_of(std::size_t task) const
  {
    std::vector<Locked> locked;
    double seconds = 0.0;
    std::string error;
    for (std::size_t s = 0; s < starts_; ++s) {
      const Attempt& a = attempts_[task * starts_ + s];
      if (a.locked) locked.push_back(*a.locked);
      if (error.empty()) error = a.error;
      seconds += a.seconds;
    }
    LimitResult result = limit_header(model_, tasks_[task]);
    try {
      if (!locked.empty()) result = summarize(model_, spec_, tasks_[task], settings_, locked);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    result.seconds = seconds;
    if (!error.empty()) {
      result.status = LimitStatus::failed;
      result.message = error;
    }
    return result;
  }

  /// Starts that were done before an interrupt are worth keeping.
  void keep_unfinished(std::size_t task)
  {
    if (missing_[task] == 0 || missing_[task] == starts_) return;
    LimitResult result = result_of(task);
    result.status = LimitStatus::interrupted;
    result.message = fmt::format("{} of {} starts were done", starts_ - missing_[task], starts_);
    results_[task] = std::move(result);
  }

  void finish(std::size_t task, LimitResult result)
  {
    missing_[task] = 0;
    results_[task] = std::move(result);
    if (observer_.on_limit) observer_.on_limit(results_);
  }

  const Model& model_;
  const SceneSpec& spec_;
  const std::vector<LimitTask>& tasks_;
  const LimitSettings& settings_;
  const LimitsObserver& observer_;
  std::size_t starts_, total_ = 0, done_ = 0;
  std::mutex mutex_;  ///< guards all below
  std::vector<Attempt> attempts_;
  std::vector<std::size_t> missing_;  ///< starts not done, by task
  std::vector<LimitResult> results_;
};

}  // namespace

std::vector<LimitResult> compute_limits(const Model& model, const SceneSpec& spec,
                                        const std::vector<LimitTask>& tasks, const LimitSettings& settings,
                                        unsigned threads, const LimitsObserver& observer,
                                        const std::vector<std::optional<LimitResult>>& known)
{
  return Computation(model, spec, tasks, settings, observer).run(threads, known);
}

}  // namespace hauberk
