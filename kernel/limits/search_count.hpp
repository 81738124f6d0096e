#pragma once
/// How many searches of a computation are done, for who follows it.

#include "limits/limits.hpp"

#include <cstddef>
#include <mutex>

namespace hauberk {

/// Counts the searches that stand alone and tells the observer, one call at a time. Thread safe.
class SearchCount {
 public:
  /// `mutex` guards what else is told while searches run. Both outlive this.
  SearchCount(const LimitsObserver& observer, std::mutex& mutex) : observer_(observer), mutex_(mutex) {}

  /// So many more are to be done.
  void expect(std::size_t searches) { tell(searches, 0); }
  void one_is_done() { tell(0, 1); }

 private:
  void tell(std::size_t expected, std::size_t done)
  {
    const std::lock_guard lock(mutex_);
    total_ += expected;
    done_ += done;
    if (observer_.on_start) observer_.on_start(done_, total_);
  }

  const LimitsObserver& observer_;
  std::mutex& mutex_;
  std::size_t total_ = 0, done_ = 0;
};

}  // namespace hauberk
