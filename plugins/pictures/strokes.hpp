#pragma once
/// Lines that are told apart.

#include "pictures/svg.hpp"

#include <cstddef>

namespace hauberk::detail {

/// How many there are.
inline constexpr std::size_t distinct_strokes = 8;

/// Told apart by dashes as well as by colour; lines beyond the last look alike.
Stroke distinct_stroke(std::size_t k);

}  // namespace hauberk::detail
