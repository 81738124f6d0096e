#include "model/scene.hpp"

#include <algorithm>
#include <limits>

namespace hauberk {

int cell_count(const std::array<int, 3>& repeat) { return repeat[0] * repeat[1] * repeat[2]; }

std::array<int, 3> cell_at(int cell, const std::array<int, 3>& repeat)
{
  return {cell % repeat[0], cell / repeat[0] % repeat[1], cell / (repeat[0] * repeat[1])};
}

bool copies_of_one_size(const SceneSpec& spec)
{
  return std::ranges::all_of(spec.elements, [&spec](const PlacedElement& e) {
    return e.copy_of < 0 || e.parameters == spec.elements[e.copy_of].parameters;
  });
}

bool cells_alike(const SceneSpec& spec, double length)
{
  const auto n = spec.elements.size() / static_cast<std::size_t>(cell_count(spec.repeat));
  for (std::size_t k = n; k < spec.elements.size(); ++k) {
    const PlacedElement &copy = spec.elements[k], &first = spec.elements[k % n];
    const std::array<int, 3> at = cell_at(static_cast<int>(k / n), spec.repeat);
    Vec3 T = Vec3::Zero();
    for (std::size_t i = 0; i < spec.lattice.size(); ++i) T += at[i] * spec.lattice[i] / spec.repeat[i];
    if (copy.type != first.type || copy.parameters != first.parameters ||
        (copy.rest.position - first.rest.position - T).norm() > rounding_of_scenes * length ||
        (copy.rest.rotation - first.rest.rotation).norm() > rounding_of_scenes)
      return false;
  }
  return true;
}

double characteristic_length(const SceneSpec& spec)
{
  if (spec.length > 0.0) return spec.length;
  std::vector<double> radii;
  for (const PlacedElement& e : spec.elements) {
    for (const Primitive& p : spec.types[e.type].shape->primitives(e.parameters)) {
      radii.push_back(p.R());
    }
  }
  if (radii.empty()) return 1.0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

double thinnest_tube(const SceneSpec& spec)
{
  double thinnest = std::numeric_limits<double>::infinity();
  for (const PlacedElement& e : spec.elements) {
    for (const Primitive& p : spec.types[e.type].shape->primitives(e.parameters))
      thinnest = std::min({thinnest, p.r0(), p.r1()});
  }
  return thinnest;
}

}  // namespace hauberk
