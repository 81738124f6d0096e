#pragma once
/// How steep a field is at most, by intervals.

#include <hauberk/kit/author.hpp>

namespace hauberk::kit {

/// Upper bound of |grad f| over the cube |x_i| <= half, from intervals over small cubes that make it up;
/// infinite where they cannot tell.
template <class Author>
double steepness(const double* q, double half)
{
  constexpr int cubes = 8;
  using J = Jet<Interval, 3, 1>;
  const auto sizes = constants<Author, J>(q);
  const double side = 2.0 * half / cubes;
  const auto range = [&](int k) { return Interval(k * side - half, (k + 1) * side - half); };
  double steepest = 0.0;
  for (int i = 0; i < cubes; ++i)
    for (int j = 0; j < cubes; ++j)
      for (int k = 0; k < cubes; ++k) {
        const Point<J> x{J::variable(range(i), 0), J::variable(range(j), 1), J::variable(range(k), 2)};
        const J f = Author::template field<J>(x, sizes.data());
        steepest = std::max(steepest, std::hypot(magnitude(f.c[1]), magnitude(f.c[2]), magnitude(f.c[3])));
      }
  return steepest * (1.0 + 1e-14);
}

}  // namespace hauberk::kit
