#pragma once
#include <hauberk/settings.hpp>

namespace hauberk {

/// The section `stability`.
Field stability_field();

}  // namespace hauberk
