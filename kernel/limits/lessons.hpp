#pragma once
/// Who can learn from whom: a locked state of one limit is a reachable state for all.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace hauberk {

/// `learner` is to be locked again from the state of `donor`.
struct Lesson {
  std::size_t learner = 0, donor = 0;
};

/// Rounds of lessons, until there are none. Every learner is paired with the donor whose state is furthest
/// along it, if that is further by `margin` (more than the gaps of a last stage) than its own state and than
/// every state that it has begun from before; so rounds end.
class Lessons {
 public:
  Lessons(std::size_t learners, std::size_t donors, double margin);

  /// How far the learner's own state is, null where it does not learn; how far a donor's is along a learner,
  /// null where it has no state to give.
  using Own = std::function<std::optional<double>(std::size_t learner)>;
  using Reached = std::function<std::optional<double>(std::size_t donor, std::size_t learner)>;

  /// The next round, by learner; empty: nothing is left to learn.
  std::vector<Lesson> next(const Own& own, const Reached& reached);

 private:
  std::size_t donors_;
  double margin_;
  std::vector<double> begun_;  ///< per learner: the furthest state that it began from
};

/// Lessons from states that are none of the learner's yet: those of loads beside its own. Following the load
/// from one direction to the next leads a locked fabric out of a fold that its own load holds it in.
///
/// Every pair of a learner and a donor is a lesson once for every state that the donor comes to, so a state
/// that goes further than those before is handed on around the circle of directions, both ways, until nobody
/// learns from it.
class Walks {
 public:
  /// Pairs of learners and donors that are beside each other.
  explicit Walks(std::vector<Lesson> beside) : beside_(std::move(beside)), taught_(beside_.size()) {}

  /// How far the donor's state is along its own load, null where it has none. A donor whose state is not
  /// further than the one that it has taught, by `margin`, has nothing new.
  using State = std::function<std::optional<double>(std::size_t donor)>;

  /// The next round, by learner; empty: nothing is left to learn.
  std::vector<Lesson> next(const State& state, double margin);

 private:
  std::vector<Lesson> beside_;
  std::vector<std::optional<double>> taught_;  ///< per pair: the state of the last lesson
};

}  // namespace hauberk
