#include "rounded_ring.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk {

std::vector<std::vector<Vec3>> RoundedRing::cores(const double* q)
{
  // R (1 - cos(pi/n)) < R pi^2/(2 n^2) <= w/2
  const int corners = std::max(12, static_cast<int>(std::ceil(std::numbers::pi * std::sqrt(q[0] / q[1]))));
  std::vector<Vec3> core;
  for (int k = 0; k < corners; ++k) {
    const kit::Turn<double> u = kit::turn(2.0 * std::numbers::pi * k / corners);
    core.emplace_back(q[0] * u.c, q[0] * u.s, 0.0);
  }
  return {core};
}

std::vector<double> RoundedRing::breaks(const double* q)
{
  const Flats<double> flat(q);
  std::vector<double> list;
  for (int side = 0; side < 4; ++side) list.push_back(0.5 * std::numbers::pi * side);
  for (const double length : {flat.h, flat.h + q[3]}) {
    // sin v - cos v = sqrt(2) sin(v - pi/4)
    const double at = 2.0 * length / (flat.w + flat.h + q[3]) - 1.0;
    const double v = 0.25 * std::numbers::pi + std::asin(at / std::numbers::sqrt2);
    for (const double same : {v, std::numbers::pi - v, std::numbers::pi + v, -v}) list.push_back(same);
  }
  return list;
}

std::vector<ParameterInfo> RoundedRing::parameters()
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), smallest = 1e-12, largest = 1e12;
  return {
      {"R", "length", none, smallest, largest, "radius of the ring, to the middle of its wire", true},
      {"w", "length", none, smallest, largest, "half the width of the wire, along the ring's radius", true},
      {"h", "length", none, smallest, largest, "half the height of the wire, along the ring's axis", true},
      {"corner", "length", none, smallest, largest, "radius of the wire's corners, at most w and h", true}};
}

void RoundedRing::check(const double* q)
{
  const double R = q[0], w = q[1], h = q[2], corner = q[3];
  if (!(w < R)) throw InputError(fmt::format("w = {:.6g} leaves no hole in a ring of R = {:.6g}", w, R));
  constexpr double finest = 1e-6;  // below, nothing is certified of its curvature
  const double size = std::max(R, h);
  for (std::size_t k = 1; k < size_names.size(); ++k)
    if (q[k] < finest * size)
      throw InputError(
          fmt::format("{} = {:.6g} is below {:g} of the ring's size {:.6g}: too fine to be computed",
                      size_names[k], q[k], finest, size));
  if (corner > std::min(w, h))
    throw InputError(
        fmt::format("corner = {:.6g} is larger than half the wire, w = {:.6g} and h = {:.6g}", corner, w, h));
}

}  // namespace hauberk
