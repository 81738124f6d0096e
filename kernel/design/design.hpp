#pragma once
/// Inverse design: element parameters whose limits come closest to targets (paper eqs. (13), (16)).

#include "design/design_result.hpp"
#include "limits/limits.hpp"

#include <hauberk/optimizer.hpp>

namespace hauberk {

/// One design variable: the same value for all its (element, parameter) entries.
struct DesignVariable {
  std::string name;
  std::vector<std::pair<int, int>> entries;
  double lower = 0.0, upper = 0.0;  ///< file units
  /// Elements of the entries, ascending.
  std::vector<int> elements() const;
};

enum class DesignQuantity { eta, positive, negative };  ///< eta, stretch (up), compress (down)

/// What stands for a limit in the objective, at the last stage of the search. Both tend to the limit as
/// stages go down; the choice of one is the choice of its gradient.
enum class DesignValue {
  less_contact,  ///< value minus contact energy: its gradient is explicit (envelope theorem), and costs
                 ///< nothing
  plain          ///< the value itself: its gradient is an adjoint one
};

struct DesignTarget {
  double direction_deg = 0.0;
  double value = 0.0;  ///< file units
  double weight = 1.0;
  Aim aim = Aim::reach;
};

/// What is designed, and under which constraints (lengths in file units).
struct DesignSpec {
  DesignQuantity quantity = DesignQuantity::eta;
  std::string quantity_name = "eta";
  std::vector<DesignVariable> variables;
  std::vector<DesignTarget> targets;
  DesignValue value = DesignValue::less_contact;
  double hole_clearance = 0.0;  ///< paper's C_ij > eps_c for every linked pair
  double rest_clearance = 0.0;  ///< surface distance of every pair at rest
  int starts = 1;
  double perturbation = 0.02;  ///< standard deviation of the starting designs, relative to upper - lower
  std::uint64_t seed = 1;
  Schedule schedule;  ///< stages of the final search (few: their bias is reported by recomputing)
  /// Activation distance that ends the stages of the first search, from every start. Limits at a coarse
  /// stage are smooth functions of the parameters, on the scale of its gaps, where exact ones have kinks.
  double coarse_last = 3e-3;
  /// Each search ends once every value is within this fraction of its target, or of a bound within
  /// `met_share`.
  std::optional<double> tolerance;
};

/// What the observer is told. Called from one thread.
struct DesignProgress {
  int start = 0, starts = 1;
  const DesignIterate* iterate = nullptr;
};
using DesignObserver = std::function<bool(const DesignProgress&)>;

/// Outcome of the optimisation; limits are recomputed from rest by the caller (`finish_design`).
struct Designed {
  DesignResult result;  ///< all but recomputed values
  SceneSpec scene;      ///< best design with its relaxed rest state
};

/// Where the limits that targets need lock when they are reported.
struct ReportedStates {
  SceneSpec scene;                           ///< the design, its rest as it is reported
  Model model;                               ///< of it
  std::vector<std::optional<State>> states;  ///< furthest ones, of each of `target_limits`
  long evaluations = 0;                      ///< of closest points, of all searches
  bool in_part = false;                      ///< the look ended at a target that is exceeded
};
/// How thoroughly the states of a design that meets its targets are looked for from rest.
enum class Look {
  usual,           ///< as those of other iterates
  quick,           ///< by a few searches of each limit: a coarse search only has to end near a design
  whole,           ///< by all that reported limits have
  until_exceeded,  ///< the same, as long as no target is exceeded, which states further on would not mend
  /// quickly; where that leads to no other values than the targets, until_exceeded; whole where that ended
  /// early and the targets are met all the same
  quick_then_whole
};
/// Computes the limits of a design, given with its relaxed rest: as they are reported (Look::whole; whoever
/// asks for it again at the end of a search can have kept them), as far as a search has use for them
/// (Look::until_exceeded), or from fewer searches (Look::quick). Called by one thread at a time.
using LimitsReport = std::function<ReportedStates(const SceneSpec& design, Look look)>;

class EvaluationMemory;

/// Runs all starts of the design with coarse stages, then continues the best of them with the final ones.
/// Evaluations that `memory` knows are not made again (evaluation_memory.hpp); null: none are known, nor
/// recorded. Throws InputError when the initial design is infeasible at rest, ComputationError when no
/// evaluation succeeds, and Interrupted where `keep_going` says no within an evaluation, which is then not
/// recorded. With `report`, a search ends only with a design whose values are those of its reported limits,
/// as far as a few continuations lead to one; the last that is asked for need not be the one that is
/// returned.
Designed run_design(
    const SceneSpec& scene, const LoadCase& load, double clearance, const LimitSettings& limits,
    const DesignSpec& design, const Optimizer& optimizer, unsigned threads, const DesignObserver& observer,
    EvaluationMemory* memory = nullptr, const KeepGoing& keep_going = [] { return true; },
    const LimitsReport& report = {});

/// Of a run that is divided: the search from one of its starts with coarse stages, for `memory` alone. Throws
/// InputError when the initial design is infeasible at rest, Interrupted as run_design. False: the observer
/// interrupted it.
bool search_start(const SceneSpec& scene, const LoadCase& load, double clearance, const LimitSettings& limits,
                  const DesignSpec& design, const Optimizer& optimizer, unsigned threads, int start,
                  const DesignObserver& observer, EvaluationMemory& memory, const KeepGoing& keep_going,
                  const LimitsReport& report);

/// The limits that targets need, each once: two bounds in one direction are of the same limits.
struct TargetLimits {
  std::vector<LimitTask> tasks;
  std::vector<std::size_t> first;  ///< per target: its task; of eta the stretch, with the compression next
};
TargetLimits target_limits(const DesignSpec& design);

/// Whether every value is within `tolerance` of its target (bounds: within `met_share`), which ends a search;
/// false without a tolerance.
bool meets_targets(const DesignSpec& design, const std::vector<double>& values);

/// Values of the designed quantity from limits in the order of `target_limits`; null where not locked.
std::vector<std::optional<double>> target_values(const DesignSpec& design,
                                                 const std::vector<LimitResult>& limits);

/// Whether some target is exceeded by more than the tolerance of a search: its limit is further than it may
/// be, and states that are found beside those of `limits` are only further. Limits in the order of
/// `target_limits`; one that is not locked exceeds nothing. False without a tolerance.
bool exceeds_targets(const DesignSpec& design, const std::vector<LimitResult>& limits);

/// Enters recomputed limits (before and after) into the result: targets, objectives, met or not.
void finish_design(DesignResult& result, const DesignSpec& design, const std::vector<LimitResult>& initial,
                   const std::vector<LimitResult>& final);

}  // namespace hauberk
