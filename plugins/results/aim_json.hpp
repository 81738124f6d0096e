#pragma once
/// How results write what a design's target asks for.

#include "design/target.hpp"
#include "document/json_place.hpp"

namespace hauberk {

/// `aim` of a target; absent: a value to reach. Throws InputError with the place where it is no aim.
Aim read_aim(const detail::JsonPlace& target);

}  // namespace hauberk
