#include "model/scene.hpp"

#include <algorithm>
#include <limits>

namespace hauberk {

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
