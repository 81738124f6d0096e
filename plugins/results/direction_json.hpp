#pragma once
/// How results write directions.

#include <hauberk/direction.hpp>

#include <boost/json/object.hpp>

namespace hauberk {

/// Adds `direction_deg`; for components that is null, and `direction` has them.
void enter_direction(boost::json::object& entry, const Direction& direction);

/// What `enter_direction` has written. Throws what boost::json throws where it has not.
Direction entered_direction(const boost::json::object& entry);

}  // namespace hauberk
