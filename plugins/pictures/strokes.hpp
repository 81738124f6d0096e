#pragma once
/// Lines that are told apart.

#include "pictures/svg.hpp"

#include <cstddef>

namespace hauberk::detail {

/// Colours come round after so many.
inline constexpr std::size_t stroke_colours = 8;

/// Told apart by dashes as well as by colour. No two are alike: beyond eight colours are dashed in other
/// ways, beyond all ways lines are thicker.
Stroke distinct_stroke(std::size_t k);

}  // namespace hauberk::detail
