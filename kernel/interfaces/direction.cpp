#include <hauberk/direction.hpp>
#include <hauberk/error.hpp>
#include <hauberk/linalg.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {

Direction Direction::at_degrees(double degrees)
{
  Direction d;
  d.degrees_ = degrees;
  d.theta_ = degrees * degree;
  return d;
}

Direction Direction::at_radians(double theta)
{
  Direction d;
  d.degrees_ = theta / degree;
  d.theta_ = theta;
  return d;
}

Direction Direction::along(std::span<const double> components)
{
  const bool finite =
      std::all_of(components.begin(), components.end(), [](double x) { return std::isfinite(x); });
  const bool zero = std::all_of(components.begin(), components.end(), [](double x) { return x == 0.0; });
  if (components.size() > max_macro || !finite || zero) {
    throw InputError(
        fmt::format("a direction needs 1 to {} finite components that are not all zero, found {}{}",
                    max_macro, components.size(),
                    !finite                       ? ", not all finite"
                    : zero && !components.empty() ? ", all zero"
                                                  : ""));
  }
  Direction d;
  std::copy(components.begin(), components.end(), d.components_.begin());
  d.count_ = components.size();
  return d;
}

std::string Direction::text() const
{
  if (is_angle()) return fmt::format("{} degrees", degrees_);
  std::string out;
  for (const double x : components()) out += fmt::format("{}{:.6g}", out.empty() ? "(" : ", ", x);
  return out + ")";
}

std::string limit_name(const std::string& sense, const Direction& direction)
{
  return fmt::format("{} {}{}", sense, direction.is_angle() ? "at " : "", direction.text());
}

}  // namespace hauberk
