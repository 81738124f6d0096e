#pragma once
/// Limits of one scene, delivered as they are finished.

#include "limits/limits.hpp"
#include "run/progress.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// What to compute, and how.
struct LimitsJob {
  const Model* model = nullptr;
  const SceneSpec* scene = nullptr;
  std::vector<LimitTask> tasks;
  LimitSettings settings;
  std::string load_case;  ///< id of the plugin, entered into every result
  unsigned threads = 1;
  std::string label;  ///< for the progress display
  /// Results that are known already, by task; empty: none.
  std::vector<std::optional<LimitResult>> known;
  SearchMemory* memory = nullptr;  ///< as LimitsObserver::memory
  /// As LimitsObserver's.
  std::function<void(const std::vector<std::optional<State>>&)> on_states = {};
  std::function<void(const std::vector<LimitResult>&)> on_unreported = {};
  std::function<bool(const std::vector<LimitResult>&)> is_enough = {};
};

/// The surface of an experiment's limits along components; null when it has none. `length` is L.
std::optional<BoundarySurface> boundary_of(const Experiment& experiment, const LimitSettings& settings,
                                           double length, const std::vector<LimitResult>& limits);

/// All limits so far; those not finished have status interrupted.
using LimitsSink = std::function<void(const std::vector<LimitResult>&)>;

/// Computes all tasks until done or interrupted by a signal, under the progress display. `sink` is called
/// after every finished limit, one call at a time.
std::vector<LimitResult> run_limits(const LimitsJob& job, Progress& progress, const LimitsSink& sink);

/// A share of the searches that stand alone, for the job's memory, which must not be null.
void run_searches(const LimitsJob& job, Progress& progress, const Share& share);

}  // namespace hauberk
