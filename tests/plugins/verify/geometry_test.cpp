#include "facets.hpp"
#include "links.hpp"
#include "neighbours.hpp"
#include "separation.hpp"
#include "surface.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace hauberk::verification {
namespace {

using std::numbers::pi;

Primitive torus(double R, double r0, double r1, const Vec3& centre = Vec3::Zero(),
                const Vec3& turn = Vec3::Zero())
{
  const Mat3 rotation = turn.norm() > 0.0
                            ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                            : Mat3::Identity();
  return {"ring", {centre, rotation}, R, r0, r1};
}

Primitive random_torus(std::mt19937_64& random, bool circular)
{
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  const double r0 = 0.6 + 0.4 * unit(random);
  return torus(4.0 + unit(random), r0, circular ? r0 : 0.8 + 0.6 * unit(random),
               8.0 * Vec3(unit(random), unit(random), unit(random)),
               3.0 * Vec3(unit(random), unit(random), unit(random)));
}

TEST(SignedDistance, KnownPoints)
{
  const Primitive ring = torus(5.0, 0.7, 1.2);
  EXPECT_NEAR(signed_distance(ring, {7.0, 0.0, 0.0}), 1.3, 1e-15);
  EXPECT_NEAR(signed_distance(ring, {0.0, 0.0, 0.0}), 4.3, 1e-15);
  EXPECT_NEAR(signed_distance(ring, {0.0, -5.0, 2.0}), 0.8, 1e-15);
  EXPECT_NEAR(signed_distance(ring, {5.0, 0.0, 0.0}), -0.7, 1e-12)
      << "the shorter half-axis, from the centre";
  EXPECT_NEAR(signed_distance(ring, {5.5, 0.0, 0.0}), -0.2, 1e-12);
}

TEST(SignedDistance, PointsAlongTheNormalOfRandomTori)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Primitive ring = random_torus(random, i % 4 == 0);
    const double u = pi * unit(random), v = pi * unit(random), step = 1e-6;
    const Vec3 du = surface_point(ring, u + step, v) - surface_point(ring, u - step, v);
    const Vec3 dv = surface_point(ring, u, v + step) - surface_point(ring, u, v - step);
    const Vec3 normal = du.cross(dv).normalized(), on = surface_point(ring, u, v);
    Vec3 outward;
    EXPECT_NEAR(signed_distance(ring, on, &outward), 0.0, 1e-13);
    EXPECT_NEAR((outward - normal).norm(), 0.0, 1e-8);
    EXPECT_NEAR(signed_distance(ring, on + 0.3 * normal), 0.3, 1e-8);
    EXPECT_NEAR(signed_distance(ring, on - 0.01 * normal), -0.01, 1e-8);
  }
}

/// Dense double sampling; never below the truth, and at most half a diagonal of its cells above.
double sampled_separation(const Primitive& a, const Primitive& b)
{
  constexpr int n = 160, m = 32;
  double best = 1e300;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      best = std::min(best, signed_distance(b, surface_point(a, 2.0 * pi * i / n, 2.0 * pi * j / m)));
  return best;
}

TEST(Separation, RandomPairsAgainstDenseSampling)
{
  std::mt19937_64 random(11);
  for (int i = 0; i < 150; ++i) {
    const Primitive a = random_torus(random, i % 3 == 0), b = random_torus(random, i % 4 == 0);
    const double found = separation(a, b), sampled = sampled_separation(a, b);
    EXPECT_LE(found, sampled + 1e-12) << i;
    if (found < 0.0) {  // intersecting surfaces have no distance: only the sign matters
      EXPECT_LT(sampled, 0.05) << i;
      continue;
    }
    EXPECT_GE(found, sampled - 0.01) << i;
    EXPECT_NEAR(found, separation(b, a), 1e-11) << i;
    EXPECT_LE(separation_bound(a, b), found + 1e-12) << i;
  }
}

TEST(Separation, ExactPairs)
{
  const Primitive ring = torus(5.0, 0.7, 0.7);
  EXPECT_NEAR(separation(ring, torus(4.0, 0.5, 0.5, {13.0, 0.0, 0.0})), 13.0 - 5.7 - 4.5, 1e-14)
      << "side by side";
  EXPECT_NEAR(separation(ring, torus(5.0, 0.7, 0.7, {0.0, 0.0, 3.0})), 1.6, 1e-14)
      << "stacked: a valley of minima";
  EXPECT_NEAR(separation(ring, torus(5.0, 0.7, 0.7, {8.6 - 1e-10, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0})), 1e-10,
              1e-14);
  EXPECT_NEAR(separation(torus(5.0, 0.7, 0.4), torus(5.0, 0.7, 0.4, {8.6, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0})),
              0.0, 1e-14)
      << "elliptical tubes lock by r0 while they are slender";
  EXPECT_NEAR(separation(torus(5.0, 0.7, 1.1), torus(5.0, 0.9, 1.3, {0.0, 0.0, 4.0})), 4.0 - 2.4, 1e-13);
}

TEST(Separation, ValleysOfFlatTubesAreFollowed)
{
  // Sharp edges that cross at a small angle: the lowest point lies in a narrow valley that runs at a slant to
  // both angles. It must be found from either surface, though the two searches have nothing in common.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  const auto tilt = [&]() -> Vec3 { return 0.01 * Vec3(unit(random), unit(random), unit(random)); };
  int apart = 0;
  for (int i = 0; i < 40; ++i) {
    const Primitive a = torus(5.0, 0.3, 0.03, Vec3::Zero(), tilt());
    const Primitive b = torus(5.0, 0.3, 0.03, {9.398, 0.0, 0.0}, Vec3(0.6, 0.0, 0.0) + tilt());
    const double found = separation(a, b);
    if (found <= 0.0) continue;  // only the sign matters
    ++apart;
    EXPECT_NEAR(found, separation(b, a), 1e-12) << i;
  }
  EXPECT_GT(apart, 20);
}

TEST(Links, HopfPairAndItsMirror)
{
  const Primitive a = torus(5.0, 0.7, 0.7), b = torus(5.0, 0.7, 0.7, {6.0, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0});
  const int number = linking_number(a, b);
  EXPECT_EQ(std::abs(number), 1);
  EXPECT_EQ(linking_number(b, a), number) << "symmetric";
  EXPECT_EQ(linking_number(a, torus(5.0, 0.7, 0.7, {6.0, 0.0, 0.0}, {-pi / 2.0, 0.0, 0.0})), -number)
      << "b reversed";
  EXPECT_EQ(linking_number(a, torus(5.0, 0.7, 0.7, {-6.0, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0})), -number);
  EXPECT_EQ(linking_number(a, torus(5.0, 0.7, 0.7, {10.5, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0})), 0) << "apart";
  EXPECT_EQ(linking_number(a, torus(1.0, 0.1, 0.1, {2.0, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0})), 0)
      << "through the disc and back";
  EXPECT_EQ(linking_number(a, torus(5.0, 0.7, 0.7, {0.0, 0.0, 1.0})), 0) << "parallel planes";
}

TEST(Links, MatchGaussIntegralOnRandomPairs)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  int linked = 0;
  for (int i = 0; i < 200; ++i) {
    Primitive a = random_torus(random, true), b = random_torus(random, true);
    a.place.position *= 0.4;
    b.place.position *= 0.4;
    if (std::abs(separation_bound(a, b) + a.r0 + b.r0) < 0.3) continue;  // the integral needs room
    constexpr int n = 120;
    double sum = 0.0;
    for (int p = 0; p < n; ++p)
      for (int q = 0; q < n; ++q) {
        const double u = 2.0 * pi * p / n, v = 2.0 * pi * q / n;
        const Vec3 x = core_point(a, u), y = core_point(b, v), d = x - y;
        const Vec3 dx = core_point(a, u + pi / 2.0) - a.place.position,
                   dy = core_point(b, v + pi / 2.0) - b.place.position;
        sum += d.dot(dx.cross(dy)) / std::pow(d.norm(), 3);
      }
    const double gauss = sum * (2.0 * pi / n) * (2.0 * pi / n) / (4.0 * pi);
    ASSERT_NEAR(std::abs(gauss), std::abs(std::round(gauss)), 0.05);
    EXPECT_EQ(std::abs(linking_number(a, b)), std::abs(std::lround(gauss))) << i;
    linked += linking_number(a, b) != 0;
  }
  EXPECT_GT(linked, 10);
}

/// The core of a torus as a curve of one harmonic.
Primitive as_curve(Primitive ring)
{
  ring.curve = {{Vec3(ring.R, 0.0, 0.0), Vec3(0.0, ring.R, 0.0)}};
  return ring;
}

TEST(Curves, CirclesAsCurvesAreTori)
{
  std::mt19937_64 random(9);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  int linked = 0;
  for (int i = 0; i < 120; ++i) {
    Primitive a = random_torus(random, true), b = random_torus(random, i % 2 == 0);
    a.place.position *= 0.4;
    b.place.position *= 0.4;
    const Vec3 x = 5.0 * Vec3(unit(random), unit(random), unit(random));
    Vec3 outward, of_curve;
    EXPECT_NEAR(signed_distance(a, x, &outward), signed_distance(as_curve(a), x, &of_curve), 1e-12);
    EXPECT_LT((outward - of_curve).norm(), 1e-6);
    EXPECT_LT((core_tangent(a, 0.3) - core_tangent(as_curve(a), 0.3)).norm(), 1e-14);
    const double apart = separation(a, b);
    if (!(apart > 0.05)) continue;
    EXPECT_NEAR(separation(as_curve(a), b), apart, 1e-11);
    if (i % 2 == 0) {
      EXPECT_NEAR(separation(as_curve(a), as_curve(b)), apart, 1e-11);
    }
    EXPECT_EQ(std::abs(linking_number(as_curve(a), b)), std::abs(linking_number(a, b)));
    linked += linking_number(a, b) != 0;
  }
  EXPECT_GT(linked, 5);
}

TEST(Curves, OfAKnotTheNearestStrandCounts)
{
  // ((4 + cos 3u) cos 2u, (4 + cos 3u) sin 2u, sin 3u) crosses the x axis at 5 (u = 0) and 3 (u = pi).
  Primitive knot = torus(4.0, 0.2, 0.2);
  knot.curve.resize(5, {Vec3::Zero(), Vec3::Zero()});
  knot.curve[1] = {Vec3(4.0, 0.0, 0.0), Vec3(0.0, 4.0, 0.0)};
  knot.curve[4] = {Vec3(0.5, 0.0, 0.0), Vec3(0.0, 0.5, 0.0)};
  knot.curve[0] = {Vec3(0.5, 0.0, 0.0), Vec3(0.0, -0.5, 0.0)};
  knot.curve[2][1].z() = 1.0;
  Vec3 outward;
  EXPECT_NEAR(signed_distance(knot, {5.5, 0.0, 0.0}, &outward), 0.3, 0.05);
  EXPECT_GT(outward.x(), 0.9);
  for (const double side : {-0.3, 0.3}) {
    const double found = signed_distance(knot, {4.0 + side, 0.0, 0.0}, &outward);
    double least = 10.0;
    for (int i = 0; i < 100000; ++i)
      least = std::min(least, (core_point(knot, 2.0 * pi * i / 100000) - Vec3(4.0 + side, 0.0, 0.0)).norm());
    EXPECT_NEAR(found, least - 0.2, 1e-8);
  }
  const Primitive ring = torus(4.0, 0.1, 0.1, {4.0, 0.0, 0.0}, {pi / 2.0, 0.0, 0.0});
  EXPECT_EQ(std::abs(linking_number(knot, ring)), 2) << "both strands through the ring's disc";
}

TEST(Neighbours, ReachBeyondTheFirstImagesOnce)
{
  Scene scene;
  scene.cell = {{2.0, 0.0, 0.0}, {1.5, 0.4, 0.0}};  // slanted: near images have large indices
  scene.elements.resize(2);
  for (Element& element : scene.elements) {
    element.tori = {torus(3.0, 0.1, 0.1)};
    element.reach = 3.1;
  }
  const std::vector<Place> places{{Vec3::Zero(), Mat3::Identity()}, {Vec3(0.3, 0.1, 0.0), Mat3::Identity()}};
  const Mat3 F = Macro{Vec3(0.2, -0.1, 0.05)}.deformation();
  std::size_t expected = 0;
  for (int i = -60; i <= 60; ++i)
    for (int j = -60; j <= 60; ++j) {
      const Vec3 t = translation(scene, F, {i, j});
      expected += (t + places[1].position).norm() <= 6.2;
      if (i > 0 || (i == 0 && j > 0)) expected += 2 * (t.norm() <= 6.2);
    }
  EXPECT_EQ(neighbours(scene, places, F, 0.0).size(), expected);
  EXPECT_GT(expected, 100u);
}

TEST(Neighbours, OfSolids)
{
  Scene scene;
  scene.cell = {{2.0, 0.0, 0.3}, {1.5, 0.7, 0.0}, {-0.4, 0.2, 1.1}};
  scene.elements.resize(2);
  for (Element& element : scene.elements) {
    element.tori = {torus(1.5, 0.1, 0.1)};
    element.reach = 1.6;
  }
  const std::vector<Place> places{{Vec3::Zero(), Mat3::Identity()}, {Vec3(0.3, 0.1, -0.2), Mat3::Identity()}};
  Macro macro{Macros::Zero(6), Load::solid};
  macro.values << 0.1, -0.2, 0.15, 0.05, -0.1, 0.02;
  const Mat3 F = macro.deformation();
  EXPECT_EQ(F, F.transpose());
  EXPECT_EQ(F.diagonal(), Vec3(1.1, 0.8, 1.15));
  EXPECT_EQ(F(1, 2), 0.05);
  EXPECT_EQ(F(0, 2), -0.1);
  EXPECT_EQ(F(0, 1), 0.02);
  std::size_t expected = 0;
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j)
      for (int k = -20; k <= 20; ++k) {
        const Vec3 t = translation(scene, F, {i, j, k});
        expected += (t + places[1].position).norm() <= 3.2;
        if (Image{i, j, k} > Image{}) expected += 2 * (t.norm() <= 3.2);
      }
  EXPECT_EQ(neighbours(scene, places, F, 0.0).size(), expected);
  EXPECT_GT(expected, 100u);
}

/// Meshes lie between the surface and what chords cut off, and know which side of each other they are on.
TEST(MeshSeparation, ApartPiercedAndInside)
{
  const auto mesh = [](Primitive ring, int facets) {
    ring.facets = facets;
    return ring;
  };
  const Primitive flat = torus(5.0, 0.7, 0.7);
  for (const double height : {1.6, 3.0}) {
    const Primitive above = torus(5.0, 0.7, 0.7, {0.2, 0.1, height}, {0.0, 0.0, 0.3});
    const double smooth = separation(flat, above);
    for (const int facets : {12, 48}) {
      const Primitive a = mesh(flat, facets), b = mesh(above, facets);
      const double found = mesh_separation(a, b);
      EXPECT_NEAR(found, smooth, mesh_excess(a) + mesh_excess(b)) << facets;
      EXPECT_NEAR(mesh_separation(b, a), found, 1e-12);
      EXPECT_EQ(separation(a, b), found) << "tori with facets are meshes";
    }
  }
  EXPECT_LT(mesh_separation(mesh(flat, 12), mesh(torus(5.0, 0.7, 0.7, {0.5, 0.0, 0.2}), 12)), 0.0);
  // A thin ring along the middle of the other's tube touches nothing.
  const Primitive thin = mesh(torus(5.0, 0.1, 0.1), 24);
  EXPECT_LT(mesh_separation(mesh(flat, 24), thin), 0.0);
  EXPECT_LT(mesh_separation(thin, mesh(flat, 24)), 0.0);
  EXPECT_NEAR(mesh_distance(mesh(flat, 40), {0.0, 0.0, 0.0}), 4.3, 0.02);
}

}  // namespace
}  // namespace hauberk::verification
