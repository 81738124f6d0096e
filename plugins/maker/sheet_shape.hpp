#pragma once
/// How wide and how thick a sheet of rings is in a state.

#include "limits/limit_result.hpp"
#include "model/scene.hpp"

#include <vector>

namespace hauberk::maker {

/// From the lowest to the highest point of the rings' surfaces, mm. Elements are single rings of round or
/// oval wire, whose highest point above their middle is R s + sqrt((r0 s)^2 + (r1 c)^2), c and s being cosine
/// and sine of the angle between their axis and z.
double thickness(const SceneSpec& scene, const std::vector<Pose>& poses);
/// The same at rest.
double thickness(const SceneSpec& scene);

/// Strain of a limit across a way: m . eps m, m at right angles to `degrees`.
double strain_across(const LimitResult& limit, double degrees);

}  // namespace hauberk::maker
