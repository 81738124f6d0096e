#pragma once
/// The searches of a computation of limits, task by task, and what each of them found: from rest, under
/// tilted loads, and from states that others have reached. Which of them are made, and in what order, is
/// decided by the computation (computation.cpp).

#include "limits/limit_report.hpp"
#include "limits/rest_searches.hpp"

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// One start of one task.
struct Attempt {
  std::optional<Locked> locked;  ///< null: not begun, interrupted, or it threw
  std::string error;
  double seconds = 0.0;
  bool needless = false;  ///< the first start has shown that nothing stops the load
};

/// What is known of a task.
struct TaskState {
  std::vector<Attempt> starts;
  std::vector<FoundState> further;  ///< by tilts, and from other limits
  std::string error;                ///< of those
  std::string remark;               ///< a lesson that threw
  double seconds = 0.0;             ///< of those, and of what led nowhere
  int iterations = 0;               ///< of what led nowhere
  long evaluations = 0;             ///< the same
  std::size_t missing = 0;          ///< starts not done
  std::size_t sparing_from = 0;     ///< RestSearches::sparing_from
  std::size_t random_loads = 0;     ///< RestSearches::random_loads
  std::size_t further_starts = 0;   ///< RestSearches::further_starts
  std::size_t refolds = 0;          ///< RestSearches::refolds
  bool narrow = false;              ///< it may fold: the last start is that without the widest stage
  bool known = false;               ///< its result came with the call; there are no states
  bool learning = false;            ///< others have taught it something, or have begun to

  bool is_narrow(std::size_t start) const { return narrow && start + 1 == starts.size(); }
  bool is_under_random_load(std::size_t start) const
  {
    const std::size_t end = starts.size() - (narrow ? 1 : 0);
    return start < end && start + random_loads >= end;
  }
  bool is_sparing(std::size_t start) const { return start >= sparing_from; }
};

/// Knows model, scene, settings and memory, which outlive it, and the state of every task: those asked for,
/// then their company. Different tasks may be searched at the same time; what one task knows is changed by
/// one thread at a time, but for `begun_from` and `refolded`.
class TaskSearches {
 public:
  /// Of the observer `keep_going` and `memory` are used.
  TaskSearches(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& asked,
               const LimitSettings& settings, const LimitsObserver& observer);

  const std::vector<LimitTask>& tasks() const { return tasks_; }
  std::size_t asked() const { return asked_; }
  const LimitSettings& settings() const { return settings_; }
  bool going() const { return !observer_.keep_going || observer_.keep_going(); }

  TaskState& of(std::size_t task) { return states_[task]; }
  const TaskState& of(std::size_t task) const { return states_[task]; }

  /// Threads that have no item of their own help with the pairs of large scenes.
  void share_out(unsigned threads, std::size_t items);

  /// What sparing starts of company may cost. Searches starts of the tasks asked for that are not sparing and
  /// not there.
  void find_allowance(unsigned threads);

  /// One start of a task, also beyond those that it begins with; it is not entered.
  Attempt attempt(std::size_t task, std::size_t start) const;

  /// Where a task locks under the k-th of its tilted loads. `seconds` grows by what it took.
  Locked tilted_search(std::size_t task, int k, double& seconds) const;

  /// Locks a task under tilted loads too, and again from where one of them is further than all that is known.
  /// False: interrupted.
  bool tilt(std::size_t task);

  /// Locked state of a task from a state that `place` names; null: it threw, which the task remarks, and what
  /// was known before stands. `allowed`: evaluations that it may have; null: as many as it takes.
  std::optional<FoundState> begun_from(std::size_t task, const State& from, const std::string& place,
                                       std::uint64_t seed, std::optional<long> allowed = std::nullopt);

  /// Locked state of a task from where a random load leads from its furthest one, of that number beyond the
  /// seed of the settings; null: it threw, which the task remarks.
  std::optional<FoundState> refolded(std::size_t task, const State& furthest, std::size_t number);

  /// Locked state of a task from where its load leads, tilted by so many degrees, of that number beyond the
  /// seed of the settings, each within the allowance of a taut task; null: it threw, which the task remarks.
  std::optional<FoundState> from_tilted_load(std::size_t task, double degrees, std::size_t number);

  /// Enters a start beyond those that a task begins with.
  void enter(std::size_t task, std::size_t start, const Attempt& found);

  /// Enters what is further than `than` (scaled, towards the task's sense), and of the rest what it took.
  bool enter_if_further(std::size_t task, FoundState found, double than);

  /// Searches again those of the tasks whose results came with the call.
  void find_states(const std::vector<std::size_t>& needed, unsigned threads);

  /// The first start of a task went past every bound, with a witness: others would say no more.
  bool runs_away(std::size_t task) const;

  /// All states of a task, in an order that does not depend on when they were found.
  std::vector<FoundState> found_of(std::size_t task) const;

  /// Its furthest one; null where there is none.
  std::optional<FoundState> furthest_of(std::size_t task) const;

  /// The result that these states give.
  LimitResult result_of(std::size_t task, const KeepGoing& keep_going) const;

  /// Whether a search of a task stalled in a state that is further than where the task's furthest one locked.
  bool gave_up_further(std::size_t task, const FoundState& found) const;

  /// What a search may have that begins again for a taut task.
  long allowance_of(std::size_t task) const;

  /// Of a search from a state: for a taut task its allowance, unless the state is further than its own.
  std::optional<long> allowance_from(std::size_t task, const State& from) const;

 private:
  Locked from_rest(std::size_t task, std::size_t start) const;
  void find_starts(const std::vector<std::size_t>& tasks, bool sparing, unsigned threads);
  LimitSettings within(long evaluations) const;
  LimitSettings settings_of(std::size_t task, std::size_t start) const;
  template <class Search>
  Locked searched(const std::string& name, double& seconds, const Search& search) const;
  template <class Search>
  std::optional<FoundState> guarded(std::size_t task, const std::string& where, const Search& search);
  Locked search_from_state(std::size_t task, const State& from, double& seconds,
                           std::optional<long> allowed = std::nullopt) const;

  const Model& model_;
  const SceneSpec& spec_;
  std::vector<LimitTask> tasks_;
  const std::size_t asked_;
  LimitSettings settings_;
  const LimitsObserver& observer_;
  std::vector<TaskState> states_;
  long allowance_ = 0;        ///< of sparing starts of company
  std::mutex begun_again_{};  ///< guards what `guarded` enters
};

}  // namespace hauberk
