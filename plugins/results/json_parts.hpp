#pragma once
/// Pieces of the results document; lengths and units as in limits/limit_result.hpp.

#include "limits/limit_result.hpp"

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>
#include <boost/json/value.hpp>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::detail {

/// A number; null when it is not finite, which JSON cannot say.
inline boost::json::value number(double x)
{
  return std::isfinite(x) ? boost::json::value(x) : boost::json::value(nullptr);
}
inline boost::json::value number(const std::optional<double>& x)
{
  return x ? number(*x) : boost::json::value(nullptr);
}

boost::json::array vector_json(const Vec3& x);
/// [w, x, y, z], unit; of the two quaternions of a rotation the one whose first non-zero component is > 0.
boost::json::array quaternion_json(const Mat3& rotation);
boost::json::object pose_json(const Pose& pose);
boost::json::object named_numbers(const std::vector<std::pair<std::string, double>>& values);

/// One of so many vectors of a lattice, as `cell.vectors` of experiments: x of one, x and y of two, all of
/// three.
boost::json::array lattice_vector_json(const Vec3& v, std::size_t vectors);

/// Scene at rest: cell vectors, characteristic length, elements with their primitives.
boost::json::object scene_json(const SceneSpec& scene);

/// One limit; `macro_names` names the unknowns of `starts` when the limit's own macro is empty.
boost::json::object limit_json(const LimitResult& limit, const std::vector<std::string>& macro_names);
boost::json::array limits_json(std::span<const LimitResult> limits,
                               const std::vector<std::string>& macro_names);

}  // namespace hauberk::detail
