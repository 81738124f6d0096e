#pragma once
/// The limits that a design's targets ask for, with their gradients.

#include "design/design_point.hpp"
#include "design/design_scene.hpp"
#include "numerics/parallel.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// Solves the targets of designs, directions in parallel. Results do not depend on the number of threads.
/// Thread safe but for `set_schedule`.
class TargetSearch {
 public:
  explicit TargetSearch(std::shared_ptr<const DesignScene> scene)
      : TargetSearch(scene, target_limits(scene->design))
  {
  }

  void set_schedule(const Schedule& schedule) { schedule_ = schedule; }
  /// Threads that may be used in all.
  unsigned threads() const { return thread_count(scene_->threads); }
  std::size_t task_count() const { return tasks_.size(); }

  /// Solves for p from the states of `from`, which may be p itself: then states are looked for from rest, and
  /// as p.look says, which is not Look::quick_then_whole.
  /// Uses up to `threads` threads. Returns how many closest points were evaluated. What cannot be computed is
  /// told in `p.why`.
  long solve(DesignPoint& p, const DesignPoint& from, unsigned threads) const;

 private:
  TargetSearch(std::shared_ptr<const DesignScene> scene, TargetLimits limits)
      : scene_(std::move(scene)),
        schedule_(scene_->design.schedule),
        tasks_(std::move(limits.tasks)),
        first_(std::move(limits.first))
  {
  }

  /// What one target asks for, locked.
  struct LockedTarget {
    Locked locked;
    std::vector<WarmStart> trail;  ///< its stages
    long evaluations = 0;
    bool followed = false;  ///< there was a state to follow
    bool changed = false;   ///< and this is not its continuation
    std::string problem;    ///< why it, or its gradient, could not be computed
  };
  /// The estimate of a limit, file units, with its gradient in the variables.
  struct Estimate {
    double value = 0.0;
    Vector gradient;
  };

  /// Locked state of one task: the continuation of the one that is known of `from`; if that is p itself, the
  /// furthest that rest leads to, or that `known` does.
  LockedTarget lock_target(const DesignPoint& p, const DesignPoint& from, const MacroLoad& load,
                           const std::vector<WarmStart>& warm, const std::optional<State>& known) const;
  Locked search(const DesignPoint& p, const State& start, const MacroLoad& load, const Schedule& schedule,
                LockedTarget& counted) const;
  Locked search_from_rest(const DesignPoint& p, const MacroLoad& load, int attempt,
                          LockedTarget& counted) const;
  /// The furthest state that rest, or `known`, leads to; false where there are states to follow, and searches
  /// from rest stalled, or come less far than these and p is to keep them.
  bool lock_from_rest(const DesignPoint& p, const MacroLoad& load, const std::vector<WarmStart>& warm,
                      const std::optional<State>& known, LockedTarget& out) const;
  /// What a warm start of a design minimises as its stage is planned; where contacts merge or ribbons jump,
  /// it may have been another formulation that ended there, and a prediction by this one is worth less.
  MinimumOf minimum_of(const DesignPoint& p, const WarmStart& warm, const MacroLoad& load) const;
  /// The continuation of a state of another design from its tightest stage that can be followed.
  bool lock_by_following(const DesignPoint& p, const DesignPoint& from, const MacroLoad& load,
                         const std::vector<WarmStart>& warm, LockedTarget& out) const;
  /// Where the limits of a design lock, per task, by the searches of its look (DesignScene::report);
  /// p tells whether that ended early.
  std::vector<std::optional<State>> reported_states(DesignPoint& p, long& evaluations) const;
  /// Targets learn from each other as limits do (compute_limits): each is locked again from the state of
  /// another that is further along its direction and keeps what it holds, until there is none.
  void learn(const DesignPoint& p, const std::vector<MacroLoad>& loads, unsigned threads,
             std::vector<LockedTarget>& targets) const;
  Estimate estimate(const DesignPoint& p, std::size_t task, const MacroLoad& load,
                    LockedTarget& target) const;
  /// Values of the targets, objective and gradient from the estimates of the tasks.
  void enter_objective(DesignPoint& p, const std::vector<Estimate>& estimates) const;

  std::shared_ptr<const DesignScene> scene_;
  Schedule schedule_;
  std::vector<LimitTask> tasks_;
  std::vector<std::size_t> first_;  ///< TargetLimits::first
};

}  // namespace hauberk
