/// The checker's own count of links: polygons that are linked a known number of times, and loops of surfaces.

#include "loops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

/// Once along a circle of radius R and `turns` times around it, at a distance a.
std::vector<Vec3> coil(double R, double a, int turns, int corners)
{
  std::vector<Vec3> out;
  for (int i = 0; i < corners; ++i) {
    const double u = 2.0 * std::numbers::pi * i / corners, rho = R + a * std::cos(turns * u);
    out.emplace_back(rho * std::cos(u), rho * std::sin(u), a * std::sin(turns * u));
  }
  return out;
}

TEST(Loops, LinksOfPolygonsAreCounted)
{
  const std::vector<Vec3> circle = coil(5.0, 0.0, 0, 24);
  for (int turns = 0; turns < 6; ++turns) {
    const std::vector<Vec3> around = coil(5.0, 1.0, turns, 24 * (turns + 1));
    const auto number = crossing_number(around, circle);
    ASSERT_TRUE(number.has_value());
    EXPECT_EQ(std::abs(*number), turns);
    EXPECT_EQ(crossing_number(circle, around), number);
    // The other way along one of them.
    const std::vector<Vec3> back(circle.rbegin(), circle.rend());
    EXPECT_EQ(crossing_number(around, back), -*number);
  }
}

/// A ring of 4 sections with 3 corners each.
Surface ring()
{
  Surface out;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double u = 0.5 * std::numbers::pi * i, v = 2.0 * std::numbers::pi * j / 3;
      out.points.emplace_back((4.0 + std::cos(v)) * std::cos(u), (4.0 + std::cos(v)) * std::sin(u),
                              std::sin(v));
      const int a = 3 * i + j, b = 3 * ((i + 1) % 4) + j, c = 3 * ((i + 1) % 4) + (j + 1) % 3,
                d = 3 * i + (j + 1) % 3;
      out.triangles.push_back({a, b, c});
      out.triangles.push_back({a, c, d});
    }
  }
  return out;
}

TEST(Loops, GenerateWhatACircleThroughTheHoleIsLinkedWith)
{
  const Surface surface = ring();
  const auto loops = homology_loops(surface, "/here");
  ASSERT_EQ(loops.size(), 2U);
  // One through the hole and around the tube, and the axis of the tube: both together see every loop.
  std::vector<Vec3> through;
  for (int i = 0; i < 12; ++i) {
    const double u = 2.0 * std::numbers::pi * (i + 0.5) / 12;
    through.emplace_back(4.0 + 2.5 * std::cos(u), 0.1, 2.5 * std::sin(u));
  }
  const std::vector<Vec3> axis{Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(-4, 0, 0), Vec3(0, -4, 0)};
  std::array<std::array<int, 2>, 2> seen{};
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<Vec3> loop;
    for (const int i : loops[k]) loop.push_back(surface.points[i]);
    seen[k] = {crossing_number(loop, through).value(), crossing_number(loop, axis).value()};
  }
  EXPECT_EQ(std::abs(seen[0][0] * seen[1][1] - seen[0][1] * seen[1][0]), 1);
}

TEST(Loops, SurfacesThatAreNotClosedAreRefused)
{
  Surface open = ring();
  open.triangles.pop_back();
  EXPECT_THROW(homology_loops(open, "/here"), Malformed);
  Surface twice = ring();
  twice.triangles.push_back(twice.triangles.front());
  EXPECT_THROW(homology_loops(twice, "/here"), Malformed);
}

}  // namespace
}  // namespace hauberk::verification
