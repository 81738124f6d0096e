#include "sheet.hpp"

#include "neighbours.hpp"
#include "roll.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hauberk::verification {
namespace {

/// Length of the curve above the line from p to q in the plane, by as many chords.
double length_above(const Macro& macro, const Vec3& p, const Vec3& q)
{
  constexpr int chords = 2000;
  const auto point = [&](int k) {
    Vec3 x = p + (q - p) * (static_cast<double>(k) / chords);
    x.z() =
        macro.values[0] * x.x() * x.x() + macro.values[1] * x.y() * x.y() + macro.values[2] * x.x() * x.y();
    return x;
  };
  double sum = 0.0;
  for (int k = 0; k < chords; ++k) sum += (point(k + 1) - point(k)).norm();
  return sum;
}

/// K of a roll, and of a strip, which bends about x.
Macros curvature_of(const Macro& macro)
{
  return macro.load == Load::strip ? Macros(Vec3(0.0, macro.values[1], 0.0)) : macro.values;
}

/// Where elements of a roll are on the flat sheet. What is along the axis of a strip stays as it is.
std::vector<Eigen::Vector2d> flat_places(const Scene& scene, const Macro& macro,
                                         const std::vector<Place>& places)
{
  std::vector<Eigen::Vector2d> out;
  for (std::size_t k = 0; k < places.size(); ++k)
    out.emplace_back(
        unrolled(curvature_of(macro), places[k].position, scene.elements[k].rest.position).head<2>());
  return out;
}

/// Extent of the places along the direction of the curvature that is largest in size, in turns.
double turns_of(const Eigen::Matrix2d& curvature, const std::vector<Eigen::Vector2d>& places)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(curvature);
  Eigen::Index most = 0;
  const double largest = principal.eigenvalues().cwiseAbs().maxCoeff(&most);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector2d& y : places) {
    const double along = principal.eigenvectors().col(most).dot(y);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return largest * (high - low) / (2.0 * std::numbers::pi);
}

}  // namespace

std::string Sheet::text() const
{
  const std::string around = turns > 0.0 ? fmt::format(", {:.3g} turns (below {:g})", turns, most_turns) : "";
  return fmt::format(
      "curvature times radius {:.3g} (a sheet below {:g}), linked elements {:.3g} times as far "
      "apart along the surface as at rest (below {:g}){}",
      curvature, most_curvature, apart, most_apart, around);
}

Sheet sheet_of(const Scene& scene, const Macro& macro, const std::vector<Place>& places,
               const std::vector<Link>& linked)
{
  Sheet out;
  double widest = 0.0;
  for (const Element& e : scene.elements) widest = std::max(widest, e.reach);
  const bool roll = macro.load != Load::paraboloid;
  const double diagonal = roll ? 1.0 : 2.0;
  const Macros k = curvature_of(macro);
  Eigen::Matrix2d second;  // derivatives of the height; at the apex they are the curvatures
  second << diagonal * k[0], k[2], k[2], diagonal * k[1];
  const std::vector<Eigen::Vector2d> flat =
      roll ? flat_places(scene, macro, places) : std::vector<Eigen::Vector2d>{};
  if (roll) out.turns = turns_of(second, flat);
  out.curvature =
      widest * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(second).eigenvalues().cwiseAbs().maxCoeff();
  for (const Link& link : linked) {
    const std::size_t i = link.elements[0], j = link.elements[1];
    const Vec3 T = translation(scene, Mat3::Identity(), link.image),
               moved = translation(scene, macro.deformation(), link.image);
    const double at_rest = (scene.elements[j].rest.position + T - scene.elements[i].rest.position).norm();
    const double unit = std::max(at_rest, 0.5 * (scene.elements[i].reach + scene.elements[j].reach));
    const double along = roll ? (flat[j] + moved.head<2>() - flat[i]).norm()
                              : length_above(macro, places[i].position, places[j].position);
    out.apart = std::max(out.apart, along / unit);
  }
  return out;
}

}  // namespace hauberk::verification
