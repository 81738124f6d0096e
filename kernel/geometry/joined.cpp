#include "geometry/joined.hpp"

#include "geometry/separation.hpp"

#include <algorithm>
#include <numeric>

namespace hauberk {
namespace {

/// Whether a gap between the surfaces of two bodies of one element is certain.
bool are_apart(const Body& A, const Body& B)
{
  const Pose element;
  if (ball_gap(A, element, B, element, 0.0) > 0.0) return true;
  return !A.surface && !B.surface && separation(A, element, B, element, 0.0, 0.0).lower > 0.0;
}

}  // namespace

std::vector<std::vector<int>> joined_primitives(std::span<const Primitive> primitives)
{
  std::vector<Body> bodies;
  for (const Primitive& primitive : primitives)
    bodies.push_back(make_body(primitive, 0, static_cast<int>(bodies.size()), 1.0));
  std::vector<std::size_t> group(bodies.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (group[a] == group[b] || are_apart(bodies[a], bodies[b])) continue;
      const std::size_t kept = std::min(group[a], group[b]), gone = std::max(group[a], group[b]);
      std::replace(group.begin(), group.end(), gone, kept);
    }
  }
  std::vector<std::vector<int>> out(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) out[group[k]].push_back(static_cast<int>(k));
  std::erase_if(out, [](const std::vector<int>& of) { return of.empty(); });
  return out;
}

}  // namespace hauberk
