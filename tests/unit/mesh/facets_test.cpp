/// Meshes of tori: closed, every feature owned once, as accurate as they should be, facets where they should
/// be.

#include <hauberk/geometry/facets.hpp>

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace hauberk::test {
namespace {

const Vec3& point(const Facets& f, int k) { return f.points()[static_cast<std::size_t>(k)]; }

TEST(Facets, ClosedAndOriented)
{
  const Facets f(5.0, 0.7, 0.9, 9);
  std::map<std::array<int, 2>, int> directed;
  for (const Facets::Triangle& t : f.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) ++directed[{t.points[k], t.points[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(directed.count({edge[1], edge[0]}), 1U) << "an edge of one triangle only";
  }
  EXPECT_EQ(directed.size(), 2 * f.edges().size());
  // Euler's characteristic of a torus.
  EXPECT_EQ(f.points().size() + f.triangles().size(), f.edges().size());
}

TEST(Facets, EveryFeatureHasOneOwner)
{
  const Facets f(5.0, 0.7, 0.9, 7);
  std::vector<int> points(f.points().size(), 0), edges(f.edges().size(), 0);
  for (const Facets::Triangle& t : f.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.own_points[k] >= 0) {
        EXPECT_EQ(t.own_points[k], t.points[k]);
        ++points[static_cast<std::size_t>(t.own_points[k])];
      }
      if (t.own_edges[k] < 0) continue;
      ++edges[static_cast<std::size_t>(t.own_edges[k])];
      const std::array<int, 2>& edge = f.edges()[static_cast<std::size_t>(t.own_edges[k])];
      EXPECT_EQ(edge, (std::array<int, 2>{t.points[k], t.points[(k + 1) % 3]}));
    }
  }
  EXPECT_EQ(points, std::vector<int>(points.size(), 1));
  EXPECT_EQ(edges, std::vector<int>(edges.size(), 1));
}

/// Volume by the divergence theorem, against 2 pi^2 R r0 r1: it converges with second order and from below 1
/// outward.
TEST(Facets, VolumeConverges)
{
  const double R = 5.0, r0 = 0.7, r1 = 0.9, exact = 2.0 * std::numbers::pi * std::numbers::pi * R * r0 * r1;
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < 3; ++level) {
    const Facets f(R, r0, r1, 20 << level);
    double volume = 0.0;
    for (const Facets::Triangle& t : f.triangles())
      volume += point(f, t.points[0]).dot(point(f, t.points[1]).cross(point(f, t.points[2]))) / 6.0;
    error[level] = volume / exact - 1.0;
  }
  EXPECT_GT(std::abs(error[0]), 0.01);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.1);
  EXPECT_NEAR(error[1] / error[2], 4.0, 0.03);
}

/// The inner equator and the sections at the body's axes run through facets.
TEST(Facets, NoPointWhereRingsRest)
{
  const Facets f(5.0, 0.7, 0.7, 20);
  const double half = std::numbers::pi / 20;
  for (const Vec3& p : f.points()) {
    const double u = std::atan2(p.y(), p.x()), v = std::atan2(p.z(), std::hypot(p.x(), p.y()) - 5.0);
    EXPECT_GT(std::abs(std::remainder(u, 2.0 * half)), 0.99 * half);
    EXPECT_GT(std::abs(std::remainder(v - std::numbers::pi, 2.0 * half)), 0.99 * half);
  }
}

TEST(Facets, SizeDerivatives)
{
  const double h = 1e-3;
  const Facets f(5.0, 0.7, 0.9, 8);
  const std::array<Facets, 3> moved{Facets(5.0 + h, 0.7, 0.9, 8), Facets(5.0, 0.7 + h, 0.9, 8),
                                    Facets(5.0, 0.7, 0.9 + h, 8)};
  for (int q = 0; q < 3; ++q) {
    for (int k = 0; k < static_cast<int>(f.points().size()); ++k) {
      const Vec3 by = (point(moved[static_cast<std::size_t>(q)], k) - point(f, k)) / h;
      EXPECT_LT((by - f.size_derivative(k).col(q)).norm(), 1e-11);
    }
  }
}

}  // namespace
}  // namespace hauberk::test
