#pragma once
/// Evaluations of designs, recalled from a former run as far as it made them, else solved; and recorded.

#include "design/evaluation_memory.hpp"
#include "design/target_search.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace hauberk {

/// Not thread safe.
class DesignJournal {
 public:
  explicit DesignJournal(std::shared_ptr<const DesignScene> scene) : scene_(std::move(scene)), search_(scene_)
  {
  }

  /// Evaluations are recalled from `memory` as far as it knows them, and recorded there; null: neither. It
  /// must outlive this.
  void set_memory(EvaluationMemory* memory) { memory_ = memory; }
  void set_schedule(const Schedule& schedule) { search_.set_schedule(schedule); }
  std::size_t task_count() const { return search_.task_count(); }
  /// Closest points that were evaluated, in the former run too.
  long evaluations() const { return evaluations_; }

  /// Evaluates designs from the states of the iterate, in parallel: none depends on another. They are
  /// recalled and recorded in their order.
  void evaluate(const std::vector<std::shared_ptr<DesignPoint>>& points, DesignPoint& iterate);
  /// Replaces states of p that were followed by those that rest leads to, and their values.
  void check(DesignPoint& p, const DesignPoint& iterate);
  /// Sees to it that p, which becomes the iterate, has its states, and that they are remembered.
  void keep_states(DesignPoint& p, const DesignPoint& iterate);

 private:
  /// What the memory knows of p. Throws ComputationError where that is of no such design: it may come from a
  /// file.
  bool recall(DesignPoint& p, long& cost) const;
  /// Warm starts of a design that was evaluated from the iterate in a run that ended before it kept them:
  /// they are found again as they were found first, at no cost that was not counted then.
  void find_states(DesignPoint& p, const DesignPoint& iterate);
  long search_again(DesignPoint& p) const;

  std::shared_ptr<const DesignScene> scene_;
  TargetSearch search_;
  EvaluationMemory* memory_ = nullptr;
  long evaluations_ = 0;
};

}  // namespace hauberk
