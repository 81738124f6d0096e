#include "torus_union.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace hauberk {
namespace {

// Radii are positive and finite; the range only has to be wide enough for any unit of length.
constexpr double smallest_length = 1e-12;
constexpr double largest_length = 1e12;
// No radius is a good guess for every ring: a forgotten one is an error.
constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TorusUnion::TorusUnion(const std::vector<std::string>& prefixes, std::vector<Torus> tori)
    : tori_(std::move(tori))
{
  const auto add = [this](const std::string& name, double value, const char* doc) {
    parameters_.push_back({name, "length", value, smallest_length, largest_length, doc, true});
  };
  for (const std::string& prefix : prefixes) {
    add(prefix + ".R", none, "radius of the ring, from its centre to the centre of the cross-section");
    add(prefix + ".r0", none, "half-width of the cross-section in the plane of the ring");
    add(prefix + ".r1", none, "half-width of the cross-section along the axis of the ring");
  }
}

void TorusUnion::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  out.clear();
  out.reserve(tori_.size());
  for (const Torus& torus : tori_) {
    const std::size_t first = 3 * static_cast<std::size_t>(torus.group);
    const double R = p[first];
    const double r0 = p[first + 1];
    const double r1 = p[first + 2];
    if (r0 >= R) {
      throw InputError(fmt::format(
          "parameter '{}' = {:g} must be smaller than '{}' = {:g}: it closes the hole of torus '{}'",
          parameters_[first + 1].name, r0, parameters_[first].name, R, torus.name));
    }
    Primitive primitive;
    primitive.name = torus.name;
    primitive.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
    double distance = 0.0;
    for (std::size_t k = 0; k < torus.weights.size(); ++k) distance += torus.weights[k] * p[k];
    primitive.position = torus.offset + distance * torus.direction;
    primitive.rotation = torus.rotation;
    primitive.size = {R, r0, r1};
    out.push_back(std::move(primitive));
  }
}

void TorusUnion::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  const std::size_t count = p.size();
  out.clear();
  out.reserve(tori_.size());
  for (const Torus& torus : tori_) {
    PrimitiveJacobian jacobian(primitive_dofs * count, 0.0);
    for (std::size_t k = 0; k < torus.weights.size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        jacobian[i * count + k] = torus.weights[k] * torus.direction[i];
      }
    }
    const std::size_t first = 3 * static_cast<std::size_t>(torus.group);
    for (std::size_t i = 0; i < 3; ++i) jacobian[(3 + i) * count + first + i] = 1.0;
    out.push_back(std::move(jacobian));
  }
}

}  // namespace hauberk
