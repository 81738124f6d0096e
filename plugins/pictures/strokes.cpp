#include "pictures/strokes.hpp"

#include <algorithm>
#include <array>

namespace hauberk::detail {

Stroke distinct_stroke(std::size_t k)
{
  static const std::array<Stroke, distinct_strokes> strokes{Stroke{"#1f4e79", 2.0, ""},
                                                            Stroke{"#c55a11", 2.0, "8,4"},
                                                            Stroke{"#2e7d32", 2.0, "2,3"},
                                                            Stroke{"#6a1b9a", 2.0, "10,3,2,3"},
                                                            Stroke{"#111111", 1.0, ""},
                                                            Stroke{"#777777", 3.0, "1,5"},
                                                            Stroke{"#00838f", 1.2, "14,3,4,3,4,3"},
                                                            Stroke{"#ad1457", 1.2, "4,2"}};
  return strokes[std::min(k, strokes.size() - 1)];
}

}  // namespace hauberk::detail
