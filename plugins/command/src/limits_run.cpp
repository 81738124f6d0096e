#include "limits_run.hpp"
#include "interrupt.hpp"

#include <hauberk/parallel.hpp>

#include <algorithm>
#include <chrono>
#include <mutex>

namespace hauberk::command {
namespace {

/// One start of one task.
struct Attempt {
  std::optional<Locked> locked;  ///< null: not begun, or it threw
  std::string error;
  double seconds = 0.0;
};

class LimitsRun {
 public:
  LimitsRun(const LimitsJob& job, Progress& progress, const LimitsObserver& observer)
      : job_(job),
        progress_(progress),
        observer_(observer),
        starts_(static_cast<std::size_t>(std::max(1, job.settings.starts))),
        attempts_(job.tasks.size() * starts_),
        missing_(job.tasks.size(), starts_)
  {
    for (std::size_t k = 0; k < job.tasks.size(); ++k)
      results_.push_back(header(k, LimitStatus::interrupted));
  }

  std::vector<LimitResult> run()
  {
    std::vector<std::size_t> items;
    for (std::size_t k = 0; k < job_.tasks.size(); ++k) {
      if (k < job_.known.size() && job_.known[k]) {
        finish(k, *job_.known[k]);
      } else if (std::optional<LimitResult> decided = decided_by_links(*job_.model, job_.tasks[k])) {
        decided->load_case = job_.load_case;
        finish(k, std::move(*decided));
      } else {
        for (std::size_t s = 0; s < starts_; ++s) items.push_back(k * starts_ + s);
      }
    }
    total_ = items.size();
    progress_.limits(job_.label, 0, total_);
    parallel_for(items.size(), job_.threads, [&](std::size_t i) {
      if (!interrupted()) solve(items[i]);
    });
    for (std::size_t k = 0; k < job_.tasks.size(); ++k) keep_unfinished(k);
    return results_;
  }

 private:
  LimitResult header(std::size_t task, LimitStatus status) const
  {
    const auto names = job_.model->load->sense_names();
    LimitResult r;
    r.load_case = job_.load_case;
    r.direction_deg = job_.tasks[task].direction_deg;
    r.sense = job_.tasks[task].sense == Sense::positive ? names.first : names.second;
    r.measure = job_.model->load->measure();
    r.status = status;
    return r;
  }

  void solve(std::size_t item)
  {
    const std::size_t task = item / starts_;
    Attempt attempt;
    const auto t0 = std::chrono::steady_clock::now();
    try {
      attempt.locked = limit_from_start(*job_.model, job_.tasks[task], job_.settings,
                                        static_cast<int>(item % starts_), [] { return !interrupted(); });
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
    progress_.limits(job_.label, ++done_, total_);
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
    LimitResult result = header(task, LimitStatus::failed);
    try {
      if (!locked.empty())
        result = summarize(*job_.model, *job_.scene, job_.tasks[task], job_.settings, locked);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    result.load_case = job_.load_case;
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
    result.message =
        std::to_string(starts_ - missing_[task]) + " of " + std::to_string(starts_) + " starts were done";
    results_[task] = std::move(result);
  }

  void finish(std::size_t task, LimitResult result)
  {
    missing_[task] = 0;
    results_[task] = std::move(result);
    observer_(results_);
  }

  const LimitsJob& job_;
  Progress& progress_;
  const LimitsObserver& observer_;
  std::size_t starts_, total_ = 0, done_ = 0;
  std::mutex mutex_;  ///< guards all below
  std::vector<Attempt> attempts_;
  std::vector<std::size_t> missing_;  ///< starts not done, by task
  std::vector<LimitResult> results_;
};

}  // namespace

std::vector<LimitResult> run_limits(const LimitsJob& job, Progress& progress, const LimitsObserver& observer)
{
  return LimitsRun(job, progress, observer).run();
}

}  // namespace hauberk::command
