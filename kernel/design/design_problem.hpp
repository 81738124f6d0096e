#pragma once
/// The design as an optimizer sees it: objective with gradient, bounds, clearance constraints, safe steps.

#include "design/constraints.hpp"
#include "design/journal.hpp"
#include "design/rest_path.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// min_x sum_i w_i/2 miss_i(value_i(x))^2 (target.hpp) under hole and rest clearances. There are no
/// equality constraints, and no Hessian is known: an optimizer has the residuals for Gauss and Newton's.
/// Evaluations run directions in parallel; results do not depend on the number of threads. Not thread safe
/// itself.
///
/// Its parts: RestPath leads the rest state from the iterate to a design, DesignConstraints hold holes and
/// pairs open, TargetSearch finds the limits that targets ask for, and DesignJournal recalls what a former
/// run found. This class knows which design is the iterate, and which ones are kept beside it.
class DesignProblem final : public OptimizationProblem {
 public:
  /// `stream` is the number of the start among several. Throws InputError when the scene has no rest state
  /// with the wanted clearance.
  explicit DesignProblem(DesignScene scene, std::uint64_t stream = 0);

  std::span<const double> lower() const override { return lower_; }
  std::span<const double> upper() const override { return upper_; }
  int constraint_count() const override { return constraints_->count(); }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override;
  /// Evaluates the points in parallel. Each depends on the iterate and its own variables alone, as
  /// evaluations start from the states of the iterate.
  std::vector<Evaluation> evaluate_batch(std::size_t count, std::span<const double> points,
                                         bool want_gradient) override;
  int residual_count() const override { return static_cast<int>(scene_->design.targets.size()); }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override;
  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override;
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override;
  void accept(std::span<const double> x) override;
  std::uint64_t stream() const override { return stream_; }

  /// See DesignJournal.
  void set_memory(EvaluationMemory* memory) { journal_.set_memory(memory); }

  /// Changes the stages, and how a design is looked at that meets its targets; the current design keeps its
  /// rest state and warm starts and is evaluated anew.
  void set_schedule(const Schedule& schedule, Look look_at_the_goal);

  /// Looks for the states of the current design from rest. If it comes out worse than an accepted one whose
  /// states had been looked for so, and which satisfies the constraints, goes back to the best of these; true
  /// then. To be called where a search ends.
  bool settle();
  /// Looks for the states of the current design with all searches that its limits are recomputed with. True
  /// where a state came out further: its values were others than the search took them for, and a search that
  /// goes on from there has them right. States that are followed from then on are kept where a look from rest
  /// comes less far: only searches as thorough as these would find them again.
  bool confirm();
  /// Goes back to the design that `confirm` left with the smallest objective; true where that is not the
  /// current one.
  bool take_best_confirmed();
  /// The last accepted design.
  const DesignPoint& current() const { return *current_; }
  /// Variables of the scene as given.
  std::vector<double> scene_variables() const { return scene_->variables(); }
  /// Moves the start along d as far as nothing collides and every constraint holds; returns the design.
  std::vector<double> feasible_towards(std::span<const double> d);
  long evaluations() const { return journal_.evaluations(); }
  /// See DesignConstraints.
  std::string impossible_hole() const { return constraints_->impossible_hole(*current_); }
  /// Smallest surface distance at rest of the current design, file units.
  double rest_distance() const;

 private:
  std::shared_ptr<DesignPoint> make_point(std::span<const double> x);
  /// The scene as given, at rest.
  std::shared_ptr<DesignPoint> start_point() const;
  /// Makes p the iterate; on request after a check.
  void take(const std::shared_ptr<DesignPoint>& p, bool look_from_rest);

  std::shared_ptr<const DesignScene> scene_;
  std::uint64_t stream_;
  std::vector<double> lower_, upper_;
  DesignJournal journal_;
  RestPath rest_path_;
  std::shared_ptr<DesignPoint> current_, last_;
  std::shared_ptr<const DesignConstraints> constraints_;
  /// Evaluated from the iterate: an optimizer may try several before it accepts one.
  std::vector<std::shared_ptr<DesignPoint>> tried_;
  /// Iterates: an optimizer may go back to its best one, which is not always on the way from the last.
  std::vector<std::shared_ptr<DesignPoint>> accepted_;
  /// The best iterate within the constraints whose states are what rest leads to; null before there is one.
  std::shared_ptr<DesignPoint> confirmed_;
  /// The last one that went through `confirm`, and the best of them; null before there is one.
  std::shared_ptr<DesignPoint> last_thorough_, best_thorough_;
  bool found_further_ = false;  ///< by `confirm`, once
  Look look_at_the_goal_ = Look::whole;
};

}  // namespace hauberk
