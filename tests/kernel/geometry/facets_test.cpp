/// Meshes of tori, of tubes around curves and of solids: closed, every feature owned once, as accurate as
/// they should be, facets where they should be.

#include "geometry/facets.hpp"

#include "delegating_strut.hpp"
#include "geometry/closed_curve.hpp"
#include "torus_solid.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace hauberk::test {
namespace {

const Vec3& point(const Facets& f, int k) { return f.points()[k]; }

double volume(const Facets& f)
{
  double sum = 0.0;
  for (const Facets::Triangle& t : f.triangles())
    sum += point(f, t.points[0]).dot(point(f, t.points[1]).cross(point(f, t.points[2]))) / 6.0;
  return sum;
}

/// Winds twice around one axis and three times around the other, out of every plane.
std::vector<Harmonic> knotted()
{
  std::vector<Harmonic> h(5);
  h[0] = {Vec3(0.3, 0.0, 0.1), Vec3(0.0, -0.3, 0.0)};
  h[1] = {Vec3(2.0, 0.0, 0.0), Vec3(0.0, 1.8, 0.0)};
  h[2].s = Vec3(0.0, 0.1, 0.9);
  h[4] = {Vec3(0.4, 0.0, 0.0), Vec3(0.0, 0.4, 0.0)};
  return h;
}

/// Every edge belongs to two triangles, which run through it both ways.
void expect_closed(const Facets& f)
{
  std::map<std::array<int, 2>, int> directed;
  for (const Facets::Triangle& t : f.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) ++directed[{t.points[k], t.points[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(directed.count({edge[1], edge[0]}), 1U) << "an edge of one triangle only";
  }
  EXPECT_EQ(directed.size(), 2 * f.edges().size());
}

TEST(Facets, ClosedAndOriented)
{
  const Facets f(5.0, 0.7, 0.9, 9);
  expect_closed(f);
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
        ++points[t.own_points[k]];
      }
      if (t.own_edges[k] < 0) continue;
      ++edges[t.own_edges[k]];
      const std::array<int, 2>& edge = f.edges()[t.own_edges[k]];
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
    error[level] = volume(f) / exact - 1.0;
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
      const Vec3 by = (point(moved[q], k) - point(f, k)) / h;
      EXPECT_LT((by - f.size_derivative(k).col(q)).norm(), 1e-11);
    }
  }
}

TEST(CurveFacets, ACircleHasTheMeshOfTheTorus)
{
  const ClosedCurve circle({{Vec3(5.0, 0.0, 0.0), Vec3(0.0, 5.0, 0.0)}}, 1.0);
  const Facets curve(circle, 0.7, 12), torus(5.0, 0.7, 0.7, 12);
  ASSERT_EQ(curve.points().size(), torus.points().size());
  for (int k = 0; k < static_cast<int>(torus.points().size()); ++k)
    EXPECT_LT((point(curve, k) - point(torus, k)).norm(), 1e-13);
  ASSERT_EQ(curve.triangles().size(), torus.triangles().size());
  for (std::size_t k = 0; k < torus.triangles().size(); ++k)
    EXPECT_EQ(curve.triangles()[k].points, torus.triangles()[k].points);
}

/// A tube's volume is pi r^2 times the length of its core.
TEST(CurveFacets, VolumeOfAKnotConverges)
{
  const ClosedCurve curve(knotted(), 1.0);
  double length = 0.0;
  constexpr int samples = 400;
  for (int i = 0; i < samples; ++i)
    length +=
        curve.at(Angle(2.0 * std::numbers::pi * i / samples)).xu.norm() * 2.0 * std::numbers::pi / samples;
  const double exact = std::numbers::pi * 0.25 * 0.25 * length;
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < 3; ++level)
    error[level] = volume(Facets(curve, 0.25, 40 << level)) / exact - 1.0;
  EXPECT_GT(std::abs(error[0]), 0.005);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.2);
  EXPECT_NEAR(error[1] / error[2], 4.0, 0.05);
}

/// Sections are rings of the tube's radius across the core, and neighbours are turned against each other by
/// no more than what is left over all around.
TEST(CurveFacets, SectionsOfAKnot)
{
  const ClosedCurve curve(knotted(), 1.0);
  constexpr int n = 30;
  const Facets f(curve, 0.25, n);
  const auto offset = [&](int i, int j) -> Vec3 {
    return point(f, (i % n) * n + j) - curve.at(Angle(2.0 * std::numbers::pi * (i % n + 0.5) / n)).x;
  };
  for (int i = 0; i < n; ++i) {
    const Vec3 t = curve.at(Angle(2.0 * std::numbers::pi * (i + 0.5) / n)).xu.normalized();
    const Vec3 s = curve.at(Angle(2.0 * std::numbers::pi * (i + 1.5) / n)).xu.normalized();
    const double bend = std::acos(std::min(1.0, t.dot(s)));
    for (int j = 0; j < n; ++j) {
      EXPECT_NEAR(offset(i, j).norm(), 0.25, 1e-14);
      EXPECT_NEAR(offset(i, j).dot(t), 0.0, 1e-14);
      EXPECT_LT((offset(i + 1, j) - offset(i, j)).norm(), 0.25 * (bend + std::numbers::pi / n));
    }
  }
}

TEST(CurveFacets, DerivativesInRadiusAndHarmonics)
{
  const std::vector<Harmonic> harmonics = knotted();
  constexpr int n = 9;
  constexpr double r = 0.25, h = 1e-5;
  const Facets f(ClosedCurve(harmonics, 1.0), r, n);
  const Facets thicker(ClosedCurve(harmonics, 1.0), r + h, n);
  for (int k = 0; k < n * n; ++k)
    EXPECT_LT(((point(thicker, k) - point(f, k)) / h - f.size_derivative(k).col(1)).norm(), 1e-9);
  for (std::size_t q = 0; q < harmonic_dofs * harmonics.size(); ++q) {
    const auto moved = [&](double by) {
      std::vector<Harmonic> now = harmonics;
      Harmonic& one = now[q / harmonic_dofs];
      (q % 6 < 3 ? one.c : one.s)[static_cast<Eigen::Index>(q % 3)] += by;
      return std::make_unique<const Facets>(ClosedCurve(now, 1.0), r, n);
    };
    const auto plus = moved(h), minus = moved(-h);
    for (int k = 0; k < n * n; ++k) {
      const Vec3 by = (point(*plus, k) - point(*minus, k)) / (2.0 * h);
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> out;
        f.add_own_sizes(k, Vec3::Unit(axis), out);
        ASSERT_EQ(out.size(), harmonic_dofs * harmonics.size());
        EXPECT_NEAR(out[q], by[axis], 1e-8) << q;
      }
    }
  }
}

TEST(SolidFacets, ATorusHasTheMeshOfTheTorus)
{
  constexpr double unit = 2.5;
  const Facets solid(TorusSolid(5.0 * unit, 0.7 * unit, 1), unit, 12), torus(5.0, 0.7, 0.7, 12);
  ASSERT_EQ(solid.points().size(), torus.points().size());
  for (int k = 0; k < static_cast<int>(torus.points().size()); ++k) {
    EXPECT_LT((point(solid, k) - point(torus, k)).norm(), 1e-14);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> by;
      solid.add_own_sizes(k, Vec3::Unit(axis), by);
      ASSERT_EQ(by.size(), 2U);
      const Eigen::RowVector3d exact = Vec3::Unit(axis).transpose() * torus.size_derivative(k);
      EXPECT_NEAR(by[0], exact[0], 1e-9);
      EXPECT_NEAR(by[1], exact[1] + exact[2], 1e-9);
    }
  }
  for (std::size_t k = 0; k < torus.triangles().size(); ++k)
    EXPECT_EQ(solid.triangles()[k].points, torus.triangles()[k].points);
  EXPECT_EQ(solid.loops().size(), 1U);
  EXPECT_TRUE(encloses(solid, torus.loops()[0]));
}

/// Points of a capsule's chart meet at both ends; the volume is 2 pi r^2 h + 4/3 pi r^3.
TEST(SolidFacets, OfAChartWithPoles)
{
  constexpr double h = 2.0, r = 0.6, pi = std::numbers::pi;
  const Capsule capsule(h, r);
  const double exact = 2.0 * pi * r * r * h + 4.0 / 3.0 * pi * r * r * r;
  std::array<double, 3> error{};
  for (std::size_t level = 0; level < 3; ++level) {
    const Facets f(capsule, 1.0, 24 << level);  // with rows where the caps begin
    expect_closed(f);
    EXPECT_EQ(f.points().size() + f.triangles().size(), f.edges().size() + 2) << "a sphere";
    for (const Vec3& x : f.points()) EXPECT_NEAR(capsule.distance(x).distance, 0.0, 1e-14);
    error[level] = volume(f) / exact - 1.0;
  }
  EXPECT_LT(error[0], 0.0);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.25);
  EXPECT_NEAR(error[1] / error[2], 4.0, 0.1);

  const Facets f(capsule, 1.0, 8);
  EXPECT_TRUE(encloses(f, {Vec3(0, 0, -h), Vec3(0, 0, 0), Vec3(0, 0, h)}));
  EXPECT_FALSE(encloses(f, {Vec3(0, 0, 0), Vec3(2.0 * r, 0, 0)}));
  EXPECT_FALSE(encloses(f, {Vec3(2.0 * r, 0, 0), Vec3(2.0 * r, 0, 1)}));
}

/// A solid that makes none of other sizes.
class Single final : public DelegatingStrut {
 public:
  Single() : DelegatingStrut(1.0, 0.2) {}
  std::string kind() const override { return "single"; }
};

TEST(SolidFacets, OfOneSizeAreRefusedByName)
{
  try {
    const Facets f(Single(), 1.0, 8);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("'single' does not"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hauberk::test
