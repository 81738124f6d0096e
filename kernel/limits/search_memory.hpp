#pragma once
/// Searches that are known by name: of a computation that was divided, or that is repeated.

#include "equilibrium/locking.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace hauberk {

/// What one search came to.
struct KnownSearch {
  Locked locked;
  double seconds = 0.0;
};

/// Outcomes of searches by name. A search is deterministic, and its name says what it begins from; so within
/// one computation what is remembered is what would be found, bit for bit. Thread safe.
class SearchMemory {
 public:
  virtual ~SearchMemory() = default;

  /// What the search of this name came to; null: it has to be done.
  virtual std::optional<KnownSearch> recall(const std::string& name) = 0;
  /// Remembers a search that was just done: one that ended, whatever with, not one that was interrupted or
  /// threw.
  virtual void record(const std::string& name, const Locked& locked, double seconds) = 0;
};

/// A memory of several computations for one of them: names begin with `prefix`.
class MemoryWithin final : public SearchMemory {
 public:
  /// `memory` outlives it.
  MemoryWithin(SearchMemory& memory, std::string prefix) : memory_(memory), prefix_(std::move(prefix)) {}

  std::optional<KnownSearch> recall(const std::string& name) override
  {
    return memory_.recall(prefix_ + name);
  }
  void record(const std::string& name, const Locked& locked, double seconds) override
  {
    memory_.record(prefix_ + name, locked, seconds);
  }

 private:
  SearchMemory& memory_;
  std::string prefix_;
};

/// Every `count`-th item of a list, from `index` on.
struct Share {
  std::size_t index = 0, count = 1;

  bool has(std::size_t item) const { return item % count == index; }
  /// The same share of what follows `items` of them, so that two lists are shared out as one.
  Share after(std::size_t items) const { return {(index + count - items % count) % count, count}; }
};

/// Whether what a search came to is of a model, in all sizes and indices: what is remembered may come from a
/// file.
bool fits(const Model& model, const Locked& locked);

/// A name for a state: equal states have equal names, and others but for one in 2^64 have other ones.
std::string name_of_state(const State& state);

}  // namespace hauberk
