#pragma once
/// Places of rigid elements.

#include <hauberk/linalg.hpp>

namespace hauberk {

/// Rigid pose: x = position + rotation * local.
struct Pose {
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
};

}  // namespace hauberk
