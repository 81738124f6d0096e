#include "sheet.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

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

}  // namespace

std::string Sheet::text() const
{
  return fmt::format(
      "curvature times radius {:.3g} (a sheet below {:g}), linked elements {:.3g} times as far "
      "apart along the surface as at rest (below {:g})",
      curvature, most_curvature, apart, most_apart);
}

Sheet sheet_of(const Scene& scene, const Macro& macro, const std::vector<Place>& places,
               const std::vector<std::array<int, 2>>& linked)
{
  Sheet out;
  double widest = 0.0;
  for (const Element& e : scene.elements) widest = std::max(widest, e.reach);
  Eigen::Matrix2d second;  // derivatives of the height; at the apex they are the curvatures
  second << 2.0 * macro.values[0], macro.values[2], macro.values[2], 2.0 * macro.values[1];
  out.curvature =
      widest * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(second).eigenvalues().cwiseAbs().maxCoeff();
  for (const auto& [i, j] : linked) {
    const std::size_t k = i, l = j;
    const double at_rest = (scene.elements[l].rest.position - scene.elements[k].rest.position).norm();
    const double unit = std::max(at_rest, 0.5 * (scene.elements[k].reach + scene.elements[l].reach));
    out.apart = std::max(out.apart, length_above(macro, places[k].position, places[l].position) / unit);
  }
  return out;
}

}  // namespace hauberk::verification
