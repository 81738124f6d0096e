#include "maker/sheet_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::maker {

double thickness(const SceneSpec& scene, const std::vector<Pose>& poses)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < scene.elements.size(); ++k) {
    const PlacedElement& element = scene.elements[k];
    const Primitive ring = scene.types[element.type].shape->primitives(element.parameters).front();
    const auto& [R, r0, r1] = ring.size;
    const Vec3 middle = poses[k].position + poses[k].rotation * ring.position;
    const double c = (poses[k].rotation * ring.rotation).col(2).z();
    const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
    const double half = R * s + std::hypot(r0 * s, r1 * c);
    low = std::min(low, middle.z() - half);
    high = std::max(high, middle.z() + half);
  }
  return high - low;
}

double thickness(const SceneSpec& scene)
{
  std::vector<Pose> rest;
  for (const PlacedElement& element : scene.elements) rest.push_back(element.rest);
  return thickness(scene, rest);
}

double strain_across(const LimitResult& limit, double degrees)
{
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  double out = 0.0;
  for (const auto& [name, value] : limit.macro) {
    if (name == "exx") out += value * s * s;
    if (name == "eyy") out += value * c * c;
    if (name == "exy") out -= 2.0 * value * s * c;
  }
  return out;
}

}  // namespace hauberk::maker
