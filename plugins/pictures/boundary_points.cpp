#include "pictures/boundary_points.hpp"

#include <algorithm>

namespace hauberk::detail {

BoundaryPoints boundary_points(const RunResult& run)
{
  constexpr int none = -1;
  BoundaryPoints out;
  std::vector<int> place(run.limits.size(), none);  // of locked ones
  for (std::size_t k = 0; k < run.limits.size(); ++k) {
    const LimitResult& limit = run.limits[k];
    const std::span<const double> d = limit.direction.components();
    if (d.size() != 3 || limit.macro.size() != 3 || !limit.value) continue;
    if (limit.status == LimitStatus::locked) place[k] = static_cast<int>(out.points.size());
    out.points.push_back({static_cast<int>(k),
                          {limit.macro[0].second, limit.macro[1].second, limit.macro[2].second},
                          {d[0], d[1], d[2]},
                          *limit.value,
                          limit.status});
  }
  if (!run.boundary) return out;
  const auto place_of = [&place](int limit) { return place[limit]; };
  for (const Triangle& t : run.boundary->triangles) {
    if (std::all_of(t.begin(), t.end(), [&](int limit) { return place_of(limit) != none; }))
      out.triangles.push_back({place_of(t[0]), place_of(t[1]), place_of(t[2])});
  }
  return out;
}

}  // namespace hauberk::detail
