/// Closed surfaces of triangles: what is refused, which way they point, the loops that generate their
/// homology.

#include "surfaces.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hauberk::test {
namespace {

std::string refusal(const Triangles& t)
{
  try {
    t.surface();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

void expect_refusal(const Triangles& t, const std::string& message)
{
  EXPECT_NE(refusal(t).find(message), std::string::npos) << "missing: " << message << "\nin: " << refusal(t);
}

double volume(const TriangleSurface& s)
{
  double six = 0.0;
  for (const auto& t : s.triangles()) {
    const auto at = [&s, &t](std::size_t k) { return s.points()[t[k]]; };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return six / 6.0;
}

TEST(TriangleSurface, PointsHaveAMeanDistanceOfOne)
{
  const Triangles given = frame();
  const TriangleSurface s = given.surface();
  double sum = 0.0;
  for (std::size_t k = 0; k < given.points.size(); ++k) {
    sum += s.points()[k].norm();
    EXPECT_LT((s.mean_distance() * s.points()[k] - given.points[k]).norm(), 1e-14);
  }
  EXPECT_NEAR(sum / static_cast<double>(given.points.size()), 1.0, 1e-15);
  EXPECT_NEAR(s.mean_distance() * s.bound(), Vec3(5.0, 3.5, 0.75).norm(), 1e-14);
  // Twice the volume over the area.
  const double volume = 1.5 * (10.0 * 7.0 - 7.0 * 4.0);
  const double area = 2.0 * (10.0 * 7.0 - 7.0 * 4.0) + 1.5 * 2.0 * (17.0 + 11.0);
  EXPECT_NEAR(s.mean_distance() * s.thickness(), 2.0 * volume / area, 1e-14);
}

TEST(TriangleSurface, PartsThatPointInwardsAreTurned)
{
  Triangles one = frame();
  EXPECT_GT(volume(one.surface()), 0.0);
  for (auto& t : one.triangles) std::swap(t[0], t[1]);
  EXPECT_GT(volume(one.surface()), 0.0);
  // One part inside out, the other not.
  const Triangles two = together(moved(one, Vec3(20.0, 0.0, 0.0)), frame());
  const TriangleSurface s = two.surface();
  EXPECT_NEAR(volume(s) * std::pow(s.mean_distance(), 3), 2.0 * 1.5 * 42.0, 1e-10);
  EXPECT_EQ(s.parts().size(), 2U);
  EXPECT_EQ(s.loops().size(), 4U);
}

TEST(TriangleSurface, PointsThatNoTriangleHasAreLeftOut)
{
  Triangles t = tetrahedron();
  t.points.insert(t.points.begin(), Vec3(100.0, 0.0, 0.0));
  for (auto& triangle : t.triangles) {
    for (int& k : triangle) ++k;
  }
  EXPECT_EQ(t.surface().points().size(), 4U);
  EXPECT_NEAR(t.surface().mean_distance(), std::sqrt(3.0), 1e-15);
}

TEST(TriangleSurface, WhatIsNoClosedSurfaceIsRefused)
{
  EXPECT_EQ(refusal(tetrahedron()), "");
  EXPECT_EQ(refusal(frame()), "");
  expect_refusal({}, "found 0 triangles; a closed surface has at least 4");
  Triangles t = tetrahedron();
  t.triangles[2][1] = 4;
  expect_refusal(t, "triangle 3 has point 5, and there are points 1 to 4");
  t = tetrahedron();
  t.triangles[0][0] = -1;
  expect_refusal(t, "triangle 1 has point 0, and there are points 1 to 4");
  t = tetrahedron();
  t.points[1].y() = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(t, "point 2 is at (1, nan, -1), which is not finite");
  t.points[1].y() = 1e200;
  expect_refusal(t, "beyond all lengths");
  t = tetrahedron();
  t.points.assign(4, Vec3::Zero());
  expect_refusal(t, "all points of the mesh are at one place");
  t = frame();
  t.triangles.pop_back();
  expect_refusal(t, "the surface is open: the edge between points 1 and 13");
  t = frame();
  std::swap(t.triangles[5][0], t.triangles[5][1]);
  expect_refusal(t, "in the same sense; make the mesh's normals consistent");
  t = frame();
  t.triangles.push_back(t.triangles[0]);
  expect_refusal(t, "belongs to 3 triangles, 1 and 8 among them");
  t = frame();
  t.points[1] = t.points[0];
  expect_refusal(t, "has no area; merge points that coincide");
  Triangles many;
  many.triangles.resize(TriangleSurface::most_triangles + 1);
  expect_refusal(many, "found 100001 triangles, more than 100000; make the mesh coarser");
}

TEST(TriangleSurface, TouchingItselfAtAPointIsRefused)
{
  const Triangles one = tetrahedron();
  Triangles two = together(one, moved(one, Vec3(2.0, 2.0, 2.0)));
  for (auto& t : two.triangles) {  // its corner (-1, -1, -1) + ... is none: join two points by hand
    for (int& k : t) k = k == 7 ? 0 : k;
  }
  expect_refusal(two, "the surface touches itself at point 1");
}

TEST(TriangleSurface, MeetingItselfIsRefused)
{
  const Triangles one = tetrahedron();
  expect_refusal(together(one, moved(one, Vec3(0.3, 0.2, 0.1))), "the surface meets itself: triangles ");
  // Apart, and one inside of the other.
  EXPECT_EQ(refusal(together(one, moved(one, Vec3(5.0, 0.0, 0.0)))), "");
  Triangles small = one;
  for (Vec3& x : small.points) x *= 0.1;
  EXPECT_EQ(refusal(together(one, small)), "");
  // Flat on each other: no edge goes through a triangle.
  Triangles box = frame();
  expect_refusal(together(box, moved(box, Vec3(0.0, 0.0, 1.5))), "the surface meets itself");
  expect_refusal(together(box, moved(box, Vec3(0.2, 0.1, 1.5))), "the surface meets itself");
  EXPECT_EQ(refusal(together(box, moved(box, Vec3(0.2, 0.1, 1.5 + 1e-9)))), "");
  // A point pushed through the opposite wall of its bar.
  box.points[1].x() += 3.0;
  expect_refusal(box, "the surface meets itself");
  // Two triangles with all corners in common, and a fold that shares an edge.
  Triangles flat{{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)},
                 {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}};
  EXPECT_NE(refusal(flat), "");
  Triangles folded{{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0.1, 0.3, 0)},
                   {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}};
  expect_refusal(folded, "the surface meets itself");
}

TEST(TriangleSurface, LargerSurfacesAreTakenToo)
{
  const TriangleSurface s = coil(5.0, 1.0, 3, 0.2, 1000).surface();
  EXPECT_EQ(s.triangles().size(), 10000U);
  EXPECT_EQ(s.loops().size(), 2U);
}

/// Steps of a loop are edges of the surface, and none comes to a point again.
void expect_loops(const TriangleSurface& s, std::size_t count)
{
  std::set<std::pair<int, int>> edges;
  for (const auto& t : s.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
  }
  ASSERT_EQ(s.loops().size(), count);
  for (const std::vector<int>& loop : s.loops()) {
    EXPECT_GE(loop.size(), 3U);
    EXPECT_EQ(std::set<int>(loop.begin(), loop.end()).size(), loop.size());
    for (std::size_t k = 0; k < loop.size(); ++k)
      EXPECT_TRUE(edges.contains({loop[k], loop[(k + 1) % loop.size()]}));
  }
}

TEST(TriangleSurface, TwoLoopsAHandle)
{
  expect_loops(tetrahedron().surface(), 0);
  expect_loops(frame().surface(), 2);
  expect_loops(coil(5.0, 1.0, 2, 0.3, 60).surface(), 2);
}

/// The loops of a thin ring are a way around the ring and one around its bar, up to the choice of generators:
/// as vectors of turns around both they have determinant one.
TEST(TriangleSurface, LoopsGenerateTheHomologyOfATorus)
{
  constexpr double pi = 3.14159265358979323846;
  const TriangleSurface s = coil(5.0, 1e-3, 0, 1.0, 17).surface();
  const auto turns = [&s](const std::vector<int>& loop) {
    double around_ring = 0.0, around_bar = 0.0;
    const auto angles = [&s](int k) {
      const Vec3 x = s.mean_distance() * s.points()[k];
      return std::array{std::atan2(x.y(), x.x()), std::atan2(x.z(), std::hypot(x.x(), x.y()) - 5.001)};
    };
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto from = angles(loop[k]), to = angles(loop[(k + 1) % loop.size()]);
      around_ring += std::remainder(to[0] - from[0], 2.0 * pi);
      around_bar += std::remainder(to[1] - from[1], 2.0 * pi);
    }
    return std::array{around_ring / (2.0 * pi), around_bar / (2.0 * pi)};
  };
  ASSERT_EQ(s.loops().size(), 2U);
  const auto a = turns(s.loops()[0]), b = turns(s.loops()[1]);
  EXPECT_NEAR(std::abs(a[0] * b[1] - a[1] * b[0]), 1.0, 1e-9);
}

}  // namespace
}  // namespace hauberk::test
