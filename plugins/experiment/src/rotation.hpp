#pragma once
#include <hauberk/linalg.hpp>
#include <hauberk/section.hpp>

namespace hauberk {

/// Rotation by `degrees` about `axis` (any length but zero), Rodrigues' formula; exact for multiples of 90
/// degrees about coordinate axes.
Mat3 rotation_about(const Vec3& axis, double degrees);

/// The rotation of a placement: {axis, degrees}, {quaternion} or null (none). Mistakes go to `problems`.
Mat3 read_rotation(const Node* rotation, Problems& problems);

}  // namespace hauberk
