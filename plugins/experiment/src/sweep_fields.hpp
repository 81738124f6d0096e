#pragma once
#include <hauberk/settings.hpp>

namespace hauberk {

/// The section `sweep`.
Field sweep_field();

}  // namespace hauberk
