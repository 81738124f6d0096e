#pragma once
/// How far a surface moves when its sizes change.

#include <hauberk/kit/chart_bounds.hpp>

#include <span>

namespace hauberk::kit {

/// Upper bound of |sum_k (d chart/d q_k) (end_k - begin_k)| over the surface and over all sizes that are
/// begin + t (end - begin) with t in [first, last]: the speed of points at fixed coordinates, per unit of t.
template <class Author>
double surface_speed(std::span<const double> begin, std::span<const double> end, double first, double last)
{
  constexpr std::size_t n = Statements<Author>::sizes;
  using J = Jet<OverCell, n, 1>;
  std::array<J, n> sizes;
  for (std::size_t k = 0; k < n; ++k) {
    const double a = std::lerp(begin[k], end[k], first), b = std::lerp(begin[k], end[k], last);
    sizes[k] = J::variable(OverCell::between(std::min(a, b), std::max(a, b)), static_cast<int>(k));
  }
  const ChartDomain domain = ChartDomain::of<Author>(begin.data());
  const bool revolved = domain.revolved && ChartDomain::of<Author>(end.data()).revolved;
  const double half_u = revolved ? 0.0 : domain.half_u(), half_v = domain.half_v();
  double fastest = 0.0;
  for (int i = 0; i < (revolved ? 1 : ChartDomain::columns); ++i)
    for (int j = 0; j < 16; ++j) {
      const Turn<OverCell> u = turn_range((2 * i + 1) * half_u, half_u, false);
      const Turn<OverCell> v = turn_range((2 * j + 1) * half_v, half_v, true);
      const Point<J> x = Author::template chart<J>({J(u.c), J(u.s)}, {J(v.c), J(v.s)}, sizes.data());
      std::array<OverCell, 3> speed;
      for (int axis = 0; axis < 3; ++axis)
        for (std::size_t k = 0; k < n; ++k)
          speed[axis] = speed[axis] + x[axis].slope(static_cast<int>(k)) * (end[k] - begin[k]);
      const double bound = longest({speed[0], speed[1], speed[2]});
      fastest = std::isfinite(bound) ? std::max(fastest, bound) : std::numeric_limits<double>::infinity();
    }
  return fastest;
}

/// The same of the whole way, in as many parts as Taylor models need; infinite where they cannot tell.
template <class Author>
double surface_speed(std::span<const double> begin, std::span<const double> end)
{
  constexpr int most_parts = 16;
  double fastest = std::numeric_limits<double>::infinity();
  for (int parts = 1; parts <= most_parts && !std::isfinite(fastest); parts *= 2) {
    fastest = 0.0;
    for (int k = 0; k < parts; ++k)
      fastest = std::max(fastest, surface_speed<Author>(begin, end, static_cast<double>(k) / parts,
                                                        static_cast<double>(k + 1) / parts));
  }
  return fastest;
}

}  // namespace hauberk::kit
