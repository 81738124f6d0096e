#include "limits/boundary.hpp"

#include <algorithm>

namespace hauberk {
namespace {

/// A locked limit along components, with what is needed of it.
struct Support {
  int limit = 0;
  double value = 0.0;
  std::vector<double> load, macro;
};

std::vector<Support> supports(const std::vector<LimitResult>& limits, const LoadCase& load)
{
  const std::size_t n = load.macro_count();
  std::vector<Support> out;
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const LimitResult& limit = limits[k];
    const bool usable = !limit.direction.is_angle() && limit.status == LimitStatus::locked && limit.value &&
                        limit.macro.size() == n;
    if (!usable) continue;
    Support s{static_cast<int>(k), *limit.value, std::vector<double>(n), {}};
    // The load depends on the ratios of components only, so it is the same in file units.
    load.load(limit.direction, s.load);
    s.macro.reserve(n);
    for (const auto& [name, value] : limit.macro) s.macro.push_back(value);
    out.push_back(std::move(s));
  }
  return out;
}

double along(const Support& direction, const Support& state)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < state.macro.size(); ++k) sum += direction.load[k] * state.macro[k];
  return sum;
}

}  // namespace

std::optional<BoundarySurface> boundary_surface(const std::vector<LimitResult>& limits,
                                                const std::vector<Triangle>& triangles, const LoadCase& load,
                                                double margin)
{
  if (std::all_of(limits.begin(), limits.end(), [](const LimitResult& l) { return l.direction.is_angle(); }))
    return std::nullopt;
  BoundarySurface out;
  out.triangles = triangles;
  out.margin = margin;
  const std::vector<Support> found = supports(limits, load);
  for (const Support& own : found) {
    BoundarySurface::Shortfall worst{own.limit, own.limit, 0.0};
    for (const Support& other : found) {
      const double by = along(own, other) - own.value;
      if (by > worst.by) worst = {own.limit, other.limit, by};
    }
    if (worst.by > margin) out.shortfalls.push_back(worst);
  }
  return out;
}

}  // namespace hauberk
