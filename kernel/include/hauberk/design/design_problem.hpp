#pragma once
/// The design as an optimizer sees it: objective with gradient, bounds, clearance constraints, safe steps.

#include <hauberk/design/evaluation_memory.hpp>

#include <map>
#include <string>
#include <vector>

namespace hauberk {

/// Violation of a constraint of a design (L) that counts as none.
constexpr double negligible_violation = 1e-6;

/// min_x sum_i w_i/2 (value_i(x) - target_i)^2 under hole and rest clearances. Evaluations run directions in
/// parallel; results do not depend on the number of threads. Not thread safe itself.
class DesignProblem final : public OptimizationProblem {
 public:
  DesignProblem(const SceneSpec& scene, const LoadCase& load, double clearance, const LimitSettings& limits,
                const DesignSpec& design, unsigned threads, KeepGoing keep_going);

  std::span<const double> lower() const override { return lower_; }
  std::span<const double> upper() const override { return upper_; }
  int constraint_count() const override { return static_cast<int>(holes_.size() + pairs_.size()); }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override;
  int residual_count() const override { return static_cast<int>(design_.targets.size()); }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override;
  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override;
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override;
  void accept(std::span<const double> x) override;

  /// Evaluations are recalled from `memory` as far as it knows them, and recorded there; null: neither. It
  /// must outlive this.
  void set_memory(EvaluationMemory* memory) { memory_ = memory; }

  /// Changes the stages; the current design keeps its rest state and warm starts and is evaluated anew.
  void set_schedule(const Schedule& schedule);

  /// Looks for the states of the current design from rest. If it comes out worse than an accepted one whose
  /// states had been looked for so, and which satisfies the constraints, goes back to the best of these; true
  /// then. To be called where a search ends.
  bool settle();
  /// The last accepted design.
  const DesignPoint& current() const { return *current_; }
  /// Variables of the scene as given.
  std::vector<double> scene_variables() const;
  /// Moves the start along d as far as nothing collides and every constraint holds; returns the design.
  std::vector<double> feasible_towards(std::span<const double> d);
  long evaluations() const { return evaluations_; }
  /// The hole that misses the hole clearance most in every design within the bounds, a sentence; empty when
  /// none does. Each hole is measured at the bounds that the derivatives at the current design point to
  /// (exact for sizes that are monotone in the variables). Throws InputError when that design is
  /// inadmissible.
  std::string impossible_hole();
  /// Smallest surface distance at rest of the current design, file units.
  double rest_distance() const;

 private:
  /// One side of a hole constraint: hole of body `ring` against half-width `size_index` of body `thread`.
  struct Hole {
    int ring, thread, size_index;
  };
  /// A pair of bodies whose rest clearance is a constraint.
  struct Pair {
    int a, b;
    Image image;
  };

  std::shared_ptr<DesignPoint> make_point(std::span<const double> x);
  /// The rest state on the way to another design, as far as it can be followed without a collision.
  struct RestPath {
    double share = 0.0;
    State rest;
  };
  RestPath rest_path(const DesignPoint& to) const;
  /// The same; the last one is remembered, as the step that is safe is then tried.
  const RestPath& follow_rest(const DesignPoint& to);
  /// Recalls or solves, and records.
  void find_targets(const std::shared_ptr<DesignPoint>& p);
  /// Solves for p from the states of `from`, which may be p itself: then states are looked for from rest.
  void solve_targets(DesignPoint& p, const DesignPoint& from);
  /// Replaces states that were followed by those that rest leads to, and their values: recalls or solves, and
  /// records.
  void check(DesignPoint& p);
  /// Makes p the iterate; on request after a check.
  void take(const std::shared_ptr<DesignPoint>& p, bool look_from_rest);
  void search_again(DesignPoint& p);
  /// Warm starts of a design that was evaluated from the iterate in a run that ended before it kept them:
  /// they are found again as they were found first, at no cost that was not counted then.
  void find_states(DesignPoint& p);
  /// What one target asks for, locked.
  struct LockedTarget {
    Locked locked;
    std::vector<WarmStart> trail;  ///< its stages
    long evaluations = 0;
    bool followed = false;  ///< there was a state to follow
    bool changed = false;   ///< and this is not its continuation
    std::string problem;    ///< why it, or its gradient, could not be computed
  };
  /// Locked state of one task: the continuation of the one that is known of `from`; if that is p itself, the
  /// furthest that rest leads to, or that `known` does.
  LockedTarget lock_target(const DesignPoint& p, const DesignPoint& from, const MacroLoad& load,
                           const std::vector<WarmStart>& warm, const std::optional<State>& known) const;
  /// The furthest states of a design that limits come to when they are computed by themselves, per task.
  std::vector<std::optional<State>> thorough_states(const DesignPoint& p);
  /// Targets learn from each other as limits do (compute_limits): each is locked again from the state of
  /// another that is further along its direction and keeps what it holds, until there is none.
  void learn(const DesignPoint& p, const std::vector<MacroLoad>& loads,
             std::vector<LockedTarget>& targets) const;
  void list_constraints();
  double rest_target(const Model& m) const;
  /// Room of a hole around its thread beyond the hole clearance, scaled.
  double hole_room(const Model& m, const Hole& h) const;

  SceneSpec scene_;
  const LoadCase& load_;
  double clearance_;
  LimitSettings limits_;
  DesignSpec design_;
  unsigned threads_;
  KeepGoing keep_going_;
  EvaluationMemory* memory_ = nullptr;
  Schedule schedule_;
  std::vector<double> lower_, upper_;
  std::vector<LimitTask> tasks_;
  std::vector<Hole> holes_;
  std::vector<Pair> pairs_;
  std::shared_ptr<DesignPoint> current_, last_;
  /// What follow_rest found last, from where, and to where.
  RestPath way_;
  std::shared_ptr<DesignPoint> way_from_;
  std::vector<double> way_to_;
  /// Evaluated from the iterate: an optimizer may try several before it accepts one.
  std::vector<std::shared_ptr<DesignPoint>> tried_;
  /// Iterates: an optimizer may go back to its best one, which is not always on the way from the last.
  std::vector<std::shared_ptr<DesignPoint>> accepted_;
  /// The best iterate within the constraints whose states are what rest leads to; null before there is one.
  std::shared_ptr<DesignPoint> confirmed_;
  long evaluations_ = 0;
};

}  // namespace hauberk
