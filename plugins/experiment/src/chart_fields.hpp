#pragma once
#include <hauberk/settings.hpp>

namespace hauberk {

/// The section `chart`.
Field chart_field();

}  // namespace hauberk
