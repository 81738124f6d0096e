#pragma once
#include <hauberk/settings.hpp>

namespace hauberk {

/// The section `transition`.
Field transition_field();

}  // namespace hauberk
