#pragma once
/// Limits of designs as they are reported: before the search, after it, and of what it may end with.

#include "design/design.hpp"
#include "run/context.hpp"
#include "run/limits_run.hpp"
#include "run/prepared.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// A scene whose limits are computed as they are reported.
struct ReportedScene {
  SceneSpec scene;
  Model model;
  LimitSettings settings;
};

/// Not thread safe; the search calls it in between its evaluations.
class DesignLimits {
 public:
  /// Tasks: those of `targets` (target_limits), then what else the result shows. `prepared` outlives it.
  DesignLimits(const Prepared& prepared, std::size_t targets, std::vector<LimitTask> tasks)
      : prepared_(prepared), targets_(targets), tasks_(std::move(tasks))
  {
  }

  const std::vector<LimitTask>& tasks() const { return tasks_; }

  ReportedScene as_it_is(const SceneSpec& scene) const;
  /// Gaps that touch are open, as in any other scene.
  ReportedScene with_open_gaps(SceneSpec scene) const;

  std::vector<LimitResult> compute(const RunContext& context, const std::string& label,
                                   const ReportedScene& of, const LimitsSink& sink) const;
  /// A share of the searches of these limits, for the memory of the run.
  void compute_part(const RunContext& context, const std::string& label, const ReportedScene& of,
                    const Share& share) const;

  /// For the search of `design`: limits of designs that it may end with, computed once for each and each
  /// look, and kept; what is asked for again costs the same evaluations, so that a run that goes on where it
  /// was stopped counts as many. Refers to this, the context and `design`.
  LimitsReport report(const RunContext& context, const DesignSpec& design);
  /// The limits of all tasks that a whole look has found for this scene; null: it was not asked for it.
  const std::vector<LimitResult>* reported(const ReportedScene& of) const;

 private:
  LimitsJob job(const RunContext& context, const std::string& label, const ReportedScene& of) const;

  struct Reported {
    Look look = Look::whole;
    ReportedStates states;
    std::vector<LimitResult> limits;
  };

  /// Null: there is none of this scene. A whole look stands for one that ends where a target is exceeded if
  /// none is, so that what is found does not depend on which of them was asked for first.
  const Reported* find(const SceneSpec& scene, Look look, const DesignSpec* design = nullptr) const;

  const Prepared& prepared_;
  std::size_t targets_;
  std::vector<LimitTask> tasks_;
  std::vector<Reported> reported_;
};

}  // namespace hauberk
