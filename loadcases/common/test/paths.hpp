#pragma once
/// Straight paths in the unknowns of one element, and what derivatives and bounds of positions keep to along
/// them.

#include <hauberk/load_case.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <span>

namespace hauberk::test {

/// From y by dy, of the macroscopic unknowns and then of the element's coordinates.
template <std::size_t macros, std::size_t all>
struct Path {
  std::array<double, all> y{}, dy{};
  Vec3 X = Vec3::Zero(), T = Vec3::Zero();

  /// Unknowns up to 1, a place up to `extent` away along each axis.
  static Path drawn(std::mt19937_64& rng, const Vec3& extent)
  {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    Path path;
    for (double& v : path.y) v = u(rng);
    for (double& v : path.dy) v = u(rng);
    for (double& x : path.X) x = u(rng);
    path.X = path.X.cwiseProduct(extent);
    return path;
  }
  PositionMap at(const LoadCase& load, double s) const
  {
    std::array<double, all> unknowns = y;
    for (std::size_t k = 0; k < all; ++k) unknowns[k] += s * dy[k];
    const std::span<const double> values(unknowns);
    PositionMap map;
    load.position(values.first(macros), values.subspan(macros), X, T, map);
    return map;
  }
  Vec3 velocity(const PositionMap& map) const
  {
    Vec3 out = Vec3::Zero();
    for (std::size_t i = 0; i < all; ++i) out += map.J.col(i) * dy[i];
    return out;
  }
  Vec3 acceleration(const PositionMap& map) const
  {
    Vec3 out = Vec3::Zero();
    for (std::size_t i = 0; i < all; ++i)
      for (std::size_t j = 0; j < all; ++j)
        out += dy[i] * dy[j] * Vec3(map.H[0][i][j], map.H[1][i][j], map.H[2][i][j]);
    return out;
  }
  /// Largest acceleration on the way over the load case's bound.
  double tightness(const LoadCase& load) const
  {
    const std::span<const double> from(y), by(dy);
    const double bound = load.acceleration_bound(from.first(macros), by.first(macros), from.subspan(macros),
                                                 by.subspan(macros), X, T);
    double largest = 0.0;
    constexpr int places = 50;
    for (int k = 0; k <= places; ++k)
      largest = std::max(largest, acceleration(at(load, static_cast<double>(k) / places)).norm());
    return largest / bound;
  }
};

/// Central differences over h and h/2: the errors of exact derivatives fall by four.
template <std::size_t macros, std::size_t all>
void expect_exact_derivatives(const LoadCase& load, const Path<macros, all>& path)
{
  const PositionMap map = path.at(load, 0.0);
  ASSERT_TRUE(map.curved);
  std::array<double, 2> first_error{}, second_error{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = k == 0 ? 4e-3 : 2e-3;
    const Vec3 a = path.at(load, h).x, b = path.at(load, -h).x;
    first_error[k] = ((a - b) / (2.0 * h) - path.velocity(map)).norm();
    second_error[k] = ((a - 2.0 * map.x + b) / (h * h) - path.acceleration(map)).norm();
  }
  EXPECT_LT(first_error[0], 1e-2);
  EXPECT_LT(second_error[0], 1e-2);
  EXPECT_NEAR(first_error[0] / first_error[1], 4.0, 0.05 + 1e-11 / first_error[1]);
  EXPECT_NEAR(second_error[0] / second_error[1], 4.0, 0.05 + 1e-8 / second_error[1]);
}

}  // namespace hauberk::test
