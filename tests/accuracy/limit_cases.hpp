#pragma once
/// Short hands for limits of test scenes.

#include <scenes.hpp>
#include "limits/limits.hpp"

namespace hauberk::brute {

/// Limits of a scene under `Sheet`; positive senses where not said otherwise.
std::vector<LimitResult> limits(const SceneSpec& scene, const std::vector<LimitTask>& tasks,
                                const LimitSettings& settings = {}, double clearance = 0.0,
                                unsigned threads = 1);

/// One limit.
LimitResult limit(const SceneSpec& scene, double direction, Sense sense, const LimitSettings& settings = {},
                  double clearance = 0.0);

/// Settings of a quick, less accurate solution.
LimitSettings fast_settings();

/// A chain of two rings whose rest period is 95 % of the locked one.
SceneSpec slack_chain(const std::array<double, 3>& first, const std::array<double, 3>& second);

}  // namespace hauberk::brute
