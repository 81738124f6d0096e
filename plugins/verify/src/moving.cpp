#include "moving.hpp"

#include "neighbours.hpp"
#include "separation.hpp"
#include "surface.hpp"
#include "touching.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace hauberk::verification {
namespace {

/// The two tori of a pair, in space.
struct PlacedPair {
  Primitive first, second;
};

PlacedPair placed_pair(const Scene& scene, const MovedState& state, int k, int l, int p, int q,
                       const Image& image)
{
  Place at = state.places[l];
  at.position += translation(scene, state.macro.deformation(), image);
  const auto& a = scene.elements[k].tori[p];
  const auto& b = scene.elements[l].tori[q];
  return {placed(a, state.places[k]), placed(b, at)};
}

GapRow pair_row(const Scene& scene, const Setting& setting, const MovedState& state, int k, int l,
                const Image& image, const Touching& touching)
{
  const double L = scene.length;
  const std::size_t a = k, b = l;
  const Vec3& n = touching.normal;
  const Vec3 FT = translation(scene, state.macro.deformation(), image);
  const PositionDerivatives da = derivatives(scene, setting, state, k, {});
  const PositionDerivatives db = derivatives(scene, setting, state, l, image);
  GapRow row{(touching.distance - setting.clearance) / L, Vector::Zero(unknowns(scene))};
  row.gradient.head(macros(scene)) = (db.macro - da.macro).transpose() * n;
  row.gradient.segment<3>(first_of(scene, k)) -= da.own.transpose() * n;
  row.gradient.segment<3>(first_of(scene, l)) += db.own.transpose() * n;
  row.gradient.segment<3>(first_of(scene, k) + 3) -= (touching.on_a - state.places[a].position).cross(n) / L;
  row.gradient.segment<3>(first_of(scene, l) + 3) +=
      (touching.on_b - state.places[b].position - FT).cross(n) / L;
  return row;
}

double height(const Scene& scene, const MovedState& state, std::size_t k)
{
  return state.places[k].position.z() - scene.elements[k].rest.position.z();
}

/// The wall above (+1) or below (-1) an element, at a fixed distance from the mean of all heights.
GapRow wall_row(const Scene& scene, const Setting& setting, const MovedState& state, int k, double side)
{
  const auto n = static_cast<double>(scene.elements.size());
  GapRow row{0.0, Vector::Zero(unknowns(scene))};
  double mean = 0.0;
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    mean += height(scene, state, e) / n;
    row.gradient[first_of(scene, static_cast<int>(e)) + 2] = side / n;
  }
  row.gap = (setting.half_height - side * (height(scene, state, static_cast<std::size_t>(k)) - mean)) /
            scene.length;
  row.gradient[first_of(scene, k) + 2] -= side;
  return row;
}

}  // namespace

GapRow row_of(const Scene& scene, const Setting& setting, const MovedState& state, const Contact& contact)
{
  const auto [k, l] = contact.elements;
  if (!contact.wall.empty()) return wall_row(scene, setting, state, k, contact.normal.z());
  const PlacedPair pair =
      placed_pair(scene, state, k, l, contact.primitives[0], contact.primitives[1], contact.image);
  return pair_row(scene, setting, state, k, l, contact.image,
                  touching_near(pair.first, pair.second, 0.5 * (contact.points[0] + contact.points[1])));
}

std::vector<GapRow> all_rows(const Scene& scene, const Setting& setting, const MovedState& state,
                             double range)
{
  const double reach = setting.clearance + range * scene.length;
  std::vector<GapRow> rows;
  for (const Neighbour& n : neighbours(scene, state.places, state.macro.deformation(), reach)) {
    const std::size_t k = n.first, l = n.second;
    for (std::size_t p = 0; p < scene.elements[k].tori.size(); ++p)
      for (std::size_t q = 0; q < scene.elements[l].tori.size(); ++q) {
        const PlacedPair pair =
            placed_pair(scene, state, n.first, n.second, static_cast<int>(p), static_cast<int>(q), n.image);
        for (const Touching& t : touchings(pair.first, pair.second, reach))
          rows.push_back(pair_row(scene, setting, state, n.first, n.second, n.image, t));
      }
  }
  if (std::isfinite(setting.half_height) && setting.half_height > 0.0) {
    for (std::size_t k = 0; k < scene.elements.size(); ++k)
      for (const double side : {1.0, -1.0})
        rows.push_back(wall_row(scene, setting, state, static_cast<int>(k), side));
  }
  return rows;
}

}  // namespace hauberk::verification
