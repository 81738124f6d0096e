#include "geometry/angle.hpp"

#include <array>
#include <numbers>

namespace hauberk {
namespace {

constexpr int table_size = 256;
constexpr double spacing = 2.0 * std::numbers::pi / table_size;
/// In two parts, so that the first times a whole number is exact.
constexpr double spacing_high = static_cast<float>(spacing), spacing_low = spacing - spacing_high;
/// Angles beyond this many turns lose digits by the division into the table's spacing.
constexpr double most_turns = 16.0;

struct AngleTable {
  std::array<double, table_size> c, s;

  AngleTable()
  {
    for (std::size_t k = 0; k < table_size; ++k) {
      const long double angle =
          2.0L * std::numbers::pi_v<long double> / table_size * static_cast<long double>(k);
      c[k] = static_cast<double>(std::cos(angle));
      s[k] = static_cast<double>(std::sin(angle));
    }
  }
};

const AngleTable angle_table;

}  // namespace

Angle::Angle(double radians)
{
  if (!(std::abs(radians) < most_turns * 2.0 * std::numbers::pi)) {
    c = std::cos(radians);
    s = std::sin(radians);
    return;
  }
  const int nearest = static_cast<int>(radians * (1.0 / spacing) + (radians < 0.0 ? -0.5 : 0.5));
  const double by = (radians - spacing_high * nearest) - spacing_low * nearest, q = by * by;
  const std::size_t k = (nearest + 16 * table_size) % table_size;
  // |by| <= pi/256: what is left out is of the order of 1e-20.
  const Angle rest(1.0 - q / 2.0 * (1.0 - q / 12.0 * (1.0 - q / 30.0)),
                   by * (1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0))));
  *this = Angle(angle_table.c[k], angle_table.s[k]).turned(rest);
}

}  // namespace hauberk
