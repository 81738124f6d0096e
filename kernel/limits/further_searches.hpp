#pragma once
/// Searches beyond the first: of limits whose searches from rest do not agree, and of stretches that elements
/// bear which are not linked with each other.

#include "limits/task_searches.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace hauberk {

/// Whether searches from rest agree on where a limit locks: every state that one of them came to another came
/// to, too, and a quarter of them came to the furthest.
///
/// The probability that the next search comes to a state that none has come to is, in expectation, about the
/// number of states that one search alone came to by the number of searches (I. J. Good, The population
/// frequencies of species and the estimation of population parameters, Biometrika 40, 1953). A search that
/// failed counts as one that ended alone.
bool searches_agree(const LimitResult& result);

/// Whether forces between elements that are not linked with each other are more than three tenths of all
/// contact forces. Links that are drawn taut hold whatever the way there; elements that clasp each other let
/// go of some and not of others, and which of them meet depends on the way.
bool is_jammed(const Model& model, const LimitResult& result);

/// One search beyond the first.
struct FurtherSearch {
  std::size_t task = 0;
  /// Of a start from rest, beyond the first; of a random or tilted load, its seed beyond that of the
  /// settings.
  std::size_t number = 0;
  /// Where a random load folds the fabric again; null: it begins from rest. Of the plan that it is of.
  const State* from = nullptr;
  /// Degrees by which the load is tilted that leads from rest to where the limit's own begins; 0: there is
  /// none.
  double tilt = 0.0;
};

/// Which limits are searched on, and from where. A limit whose first searches agree is not, unless others
/// lead it further; one that is taut is where it is jammed, under tilted loads. Not thread safe.
class FurtherSearches {
 public:
  /// `searches` outlives it; of its tasks those that are asked for are searched on.
  FurtherSearches(const Model& model, const TaskSearches& searches);

  /// Whether this is of a task that may be searched on.
  bool may_go_on(std::size_t task) const { return searches_.of(task).further_starts > 0; }

  /// Tasks whose searches from rest do not agree, by the results of these, and taut ones that are jammed.
  /// None that nothing stops: others would say no more.
  std::vector<std::size_t> undecided(const std::vector<LimitResult>& results);
  /// Their searches from rest: starts, of taut tasks under tilted loads.
  std::vector<FurtherSearch> from_rest(const std::vector<std::size_t>& undecided) const;

  /// Tasks that may be folded again: undecided ones, and others that came further since.
  std::vector<std::size_t> unfolded(const std::vector<LimitResult>& results) const;
  /// Random loads from the furthest state of each, whose states are there (TaskSearches::find_states); they
  /// point into this until the next call.
  std::vector<FurtherSearch> refolds(const std::vector<std::size_t>& unfolded);

  /// How far the state is that a task is folded again from, scaled and towards its sense.
  double refolded_from(std::size_t task) const { return *begun_[task]; }

 private:
  const Model& model_;
  const TaskSearches& searches_;
  std::vector<std::optional<double>> agreed_;  ///< the value that the first searches agreed on
  std::vector<std::optional<double>> begun_;   ///< how far the furthest state was that loads began from
  std::vector<std::size_t> loads_;             ///< how many there were
  std::vector<State> furthest_;
};

}  // namespace hauberk
