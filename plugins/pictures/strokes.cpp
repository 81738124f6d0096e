#include "pictures/strokes.hpp"

#include <array>

namespace hauberk::detail {

Stroke distinct_stroke(std::size_t k)
{
  constexpr std::size_t count = stroke_colours;
  static const std::array<Stroke, count> strokes{Stroke{"#1f4e79", 2.0, ""},
                                                 Stroke{"#c55a11", 2.0, "8,4"},
                                                 Stroke{"#2e7d32", 2.0, "2,3"},
                                                 Stroke{"#6a1b9a", 2.0, "10,3,2,3"},
                                                 Stroke{"#111111", 1.0, "12,2"},
                                                 Stroke{"#777777", 3.0, "1,5"},
                                                 Stroke{"#00838f", 1.2, "14,3,4,3,4,3"},
                                                 Stroke{"#ad1457", 1.2, "4,2"}};
  const std::size_t round = k / count;
  Stroke out = strokes[k % count];
  out.dash = strokes[(k + round) % count].dash;
  constexpr double thicker = 0.6;
  out.width += thicker * static_cast<double>(round / count);
  return out;
}

}  // namespace hauberk::detail
