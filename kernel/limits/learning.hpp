#pragma once
/// What limits learn beyond their own searches: from more searches where the first do not agree, from scenes
/// that theirs contains, and from each other.

#include "limits/donors.hpp"
#include "limits/further_searches.hpp"
#include "limits/scenes_within.hpp"
#include "limits/search_count.hpp"
#include "limits/task_searches.hpp"

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// Adds to the searches of the tasks that are asked for, and makes their results anew; of company, results
/// only teach. A task that is interrupted while it learns is so in its result: a run that goes on asks again.
/// What is passed outlives it.
class Learning {
 public:
  /// One result per task of `searches`, which have ended their searches from rest.
  Learning(const Model& model, TaskSearches& searches, const ScenesWithin& within,
           const LimitsObserver& observer, SearchCount& count, std::vector<LimitResult>& results);

  /// Until nothing is learnt, or `is_enough` says so between rounds. Limits of the scenes within are added to
  /// `unreported`.
  void run(const Donors& donors, const std::function<bool()>& is_enough, std::vector<LimitResult>& unreported,
           unsigned threads);

 private:
  void search_on(unsigned threads);
  bool inherit(const Donors& donors, std::vector<LimitResult>& unreported, unsigned threads);
  void learn(const Donors& donors, const std::function<bool()>& is_enough, unsigned threads);
  bool refold(int round, unsigned threads);
  template <class Search>
  void in_a_round(int round, std::size_t count, unsigned threads, const Search& search);

  std::optional<Vector> macro_of(std::size_t task) const;
  std::optional<double> reached_by(const Donors& donors, std::size_t donor, std::size_t task) const;
  std::string learnt_from(const Donors& donors, std::size_t donor) const;
  std::optional<FoundState> taught(const Donors& donors, std::size_t task, std::size_t donor, bool further);
  void find_states(const Donors& donors, const std::vector<Lesson>& lessons, unsigned threads);
  void look_again(std::size_t task);
  void stopped(std::size_t task, const std::string& message);
  void stopped_before(std::size_t task, const std::string& place);
  bool going() const { return searches_.going(); }

  const Model& model_;
  TaskSearches& searches_;
  const ScenesWithin& within_;
  const LimitsObserver& observer_;
  SearchCount& count_;
  std::vector<LimitResult>& results_;
  const std::vector<LimitTask>& tasks_;
  const std::size_t asked_;
  const LimitSettings& settings_;
  FurtherSearches further_;
  std::mutex mutex_;  ///< guards lessons that are done
};

}  // namespace hauberk
