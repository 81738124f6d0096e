#pragma once
/// What is made once and kept, in any thread.

#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

namespace hauberk::kit {

/// A value that is made by the first call that asks for it. Thread safe.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) const
  {
    std::call_once(once_, [&] { value_.emplace(make()); });
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::optional<T> value_;
};

/// The last solids that were made, by their sizes: what is certified of a solid takes milliseconds, and
/// elements of one type ask for the same. Thread safe.
template <class S>
class KeptSolids {
 public:
  /// `make` gives a solid of these sizes; where it throws, nothing is kept.
  template <class Make>
  std::shared_ptr<const S> get(std::span<const double> sizes, const Make& make) const
  {
    const std::lock_guard lock(mutex_);
    for (const auto& known : made_)
      if (std::ranges::equal(known->sizes(), sizes)) return known;
    made_.push_front(make());
    if (made_.size() > most) made_.pop_back();
    return made_.front();
  }

 private:
  static constexpr std::size_t most = 64;
  mutable std::mutex mutex_;
  mutable std::deque<std::shared_ptr<const S>> made_;
};

}  // namespace hauberk::kit
