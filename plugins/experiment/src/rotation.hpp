#pragma once
/// Rotations as experiments give them.

#include <hauberk/linalg.hpp>
#include <hauberk/section.hpp>

#include <string>

namespace hauberk {

/// Rotation by `degrees` about `axis` (any length but zero), Rodrigues' formula; exact for multiples of 90
/// degrees about coordinate axes.
Mat3 rotation_about(const Vec3& axis, double degrees);

/// The field `rotation` of what has an origin: an element, or a part of one.
Field rotation_field(const std::string& of);

/// What such a field says: {axis, degrees}, {quaternion} or null (none). Mistakes go to `problems`.
Mat3 read_rotation(const Node* rotation, Problems& problems);

}  // namespace hauberk
