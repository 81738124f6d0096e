/// Spines: where primitives of an element overlap, the loops that they form, and what those are linked with.

#include "geometry/spine.hpp"

#include "geometry/closed_curve.hpp"
#include "geometry/separation.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

using std::numbers::pi;

Body torus(double R, double r0, double r1, const Vec3& center, const Vec3& axis = Vec3::UnitZ())
{
  Body b;
  b.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  b.R = R;
  b.r0 = r0;
  b.r1 = r1;
  b.center = center;
  b.axes = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
  b.bound = R + std::max(r0, r1);
  return b;
}

/// Four tori of radius 1 on the corners of a square of this side; each overlaps with its neighbours where
/// side < 2 + 2 r, at two places where side < 2.
std::vector<Body> square(double side, double r)
{
  std::vector<Body> out;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    out.push_back(torus(1.0, r, r, 0.5 * side * Vec3(x, y, 0.0)));
  return out;
}

std::vector<Body> cage(double R, double r0, double r1)
{
  return {torus(R, r0, r1, Vec3::Zero(), Vec3::UnitX()), torus(R, r0, r1, Vec3::Zero(), Vec3::UnitY()),
          torus(R, r0, r1, Vec3::Zero())};
}

Pose at(const Vec3& position, const Vec3& axis = Vec3::UnitZ(), double angle = 0.0)
{
  return {position, Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix()};
}

TEST(Joins, OneForEachPartThatSolidsShare)
{
  const Body one = torus(1.0, 0.1, 0.1, Vec3::Zero());
  const auto count = [&](const Body& other) { return joins(one, other).size(); };
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, {2.21, 0.0, 0.0})), 0U) << "apart";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, {2.2, 0.0, 0.0})), 1U) << "touching";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, {2.0, 0.0, 0.0})), 1U);
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, {1.0, 0.0, 0.0})), 2U) << "circles that cross twice";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, Vec3::Zero())), 1U) << "the same solid";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, {0.0, 0.0, 0.15})), 1U) << "overlapping all along";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, {1.0, 0.0, 0.0}, Vec3::UnitY())), 0U) << "linked, not touching";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.1, Vec3::Zero(), Vec3::UnitY())), 2U) << "great circles";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.3, Vec3::Zero(), Vec3::UnitY())), 2U) << "of an ellipse";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.3, {0.0, 0.0, 0.401})), 0U) << "an ellipse beyond its reach";
  EXPECT_EQ(count(torus(1.0, 0.1, 0.3, {0.0, 0.0, 0.39})), 1U) << "an ellipse within its reach, all along";
  EXPECT_EQ(count(torus(0.05, 0.02, 0.02, {1.0, 0.0, 0.0})), 1U) << "inside of the solid";
}

TEST(Joins, OvalTubesAgainstRoundOnesThatTheyLieBetween)
{
  // A tube lies in an oval one, and that in a thicker tube: what meets the inner one meets it, what misses
  // the outer one misses it.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  int met = 0, missed = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 center(1.5 * unit(random), 1.5 * unit(random), 0.5 * unit(random));
    const Vec3 axis = Vec3(unit(random), unit(random), unit(random)).normalized();
    const Body other = torus(1.0, 0.1, 0.1, center, axis);
    const std::size_t oval = joins(other, torus(1.0, 0.1, 0.14, Vec3::Zero())).size();
    if (!joins(other, torus(1.0, 0.1, 0.1, Vec3::Zero())).empty()) {
      EXPECT_GT(oval, 0U) << k;
      ++met;
    }
    if (joins(other, torus(1.0, 0.14, 0.14, Vec3::Zero())).empty()) {
      EXPECT_EQ(oval, 0U) << k;
      ++missed;
    }
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(missed, 20);
}

/// Tubes as tall as a tower: what the solids share is a bent valley of the level, along which steps of
/// coordinates creep.
TEST(Joins, TheDeepestPlaceIsFoundInABentValley)
{
  const auto side = [](double angle) {
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    return torus(2.575, 0.95, 59.0, 6.825 * out, Vec3::UnitZ().cross(out));
  };
  const Body a = side(0.0), b = side(2.0 * pi / 3.0);
  const auto level = [](const Body& t, const Vec3& x) {
    const Vec3 p = t.axes.transpose() * (x - t.center);
    return std::hypot((std::hypot(p.x(), p.y()) - t.R) / t.r0, p.z() / t.r1);
  };
  double least = 1e300;
  constexpr int n = 60;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k < n; ++k) {
        const double u = 2.0 * pi * i / n, s = static_cast<double>(j) / n, w = 2.0 * pi * k / n;
        const Vec3 way = std::cos(u) * a.axes.col(0) + std::sin(u) * a.axes.col(1);
        const Vec3 x =
            a.center + (a.R + s * a.r0 * std::cos(w)) * way + s * a.r1 * std::sin(w) * a.axes.col(2);
        least = std::min(least, level(b, x));
      }
  double found = 1e300;
  for (const Join& join : joins(a, b)) {
    EXPECT_LE(level(a, join.common), 1.0 + 1e-9);
    found = std::min(found, level(b, join.common));
  }
  EXPECT_LE(found, least);
}

TEST(Spine, HasTheFirstBettiNumberOfTheSolid)
{
  EXPECT_EQ(make_spine(cage(1.0, 0.1, 0.1)).loops.size(), 4U) << "an octahedron's edges: 12 - 6 + 1 = 3 + 4";
  EXPECT_EQ(make_spine(cage(1.0, 0.1, 0.15)).loops.size(), 4U);
  EXPECT_EQ(make_spine(square(2.1, 0.1)).loops.size(), 1U);
  EXPECT_EQ(make_spine(square(2.3, 0.1)).loops.size(), 0U) << "apart";
  EXPECT_EQ(make_spine(square(1.7, 0.1)).loops.size(), 5U) << "eight joins of four tori";
}

TEST(Spine, LiesInsideOfItsElement)
{
  for (const std::vector<Body>& bodies : {cage(1.0, 0.1, 0.1), square(2.1, 0.1), cage(1.0, 0.1, 0.2)}) {
    for (const std::vector<Vec3>& piece : make_spine(bodies).pieces) {
      for (std::size_t k = 0; k + 1 < piece.size(); ++k) {
        for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
          const Vec3 x = piece[k] + t * (piece[k + 1] - piece[k]);
          double deepest = 1e300;
          for (const Body& b : bodies) {
            const Vec3 p = b.axes.transpose() * (x - b.center);
            deepest = std::min(deepest, std::hypot((std::hypot(p.x(), p.y()) - b.R) / b.r0, p.z() / b.r1));
          }
          EXPECT_LT(deepest, 1.0 + 1e-9);
        }
      }
    }
  }
}

TEST(Spine, ARingThroughTheLoopOfSeveralTori)
{
  const Spine loop = make_spine(square(2.1, 0.1));
  const Spine ring = make_spine(std::vector<Body>{torus(1.5, 0.1, 0.1, Vec3::Zero())});
  // Around the place where two of them overlap: through the square's middle, through no torus.
  const Pose through = at({0.0, 1.5, 0.0}, Vec3::UnitY(), pi / 2.0);
  const Eigen::MatrixXi linked = linking_numbers(loop, Pose{}, ring, through);
  ASSERT_EQ(linked.rows(), 5);
  ASSERT_EQ(linked.cols(), 1);
  EXPECT_EQ(std::abs(linked(4, 0)), 1);
  EXPECT_EQ(linking_numbers(ring, through, loop, Pose{}).transpose(), linked) << "symmetric";
  EXPECT_TRUE(linking_numbers(loop, Pose{}, ring, at({0.0, 1.5, 2.0})).isZero()) << "above";
  EXPECT_TRUE(linking_numbers(loop, Pose{}, ring, at({0.0, 5.5, 0.0}, Vec3::UnitY(), pi / 2.0)).isZero());
}

TEST(Spine, ViewsAgreeWithGaussAndWithCircles)
{
  // Every cycle that is a circle, as a loop of several primitives sees it: linking numbers of the polygons of
  // all cycles of a cage with a ring, from the view, against Gauss's integral, and of circles the exact ones.
  std::mt19937_64 random(11);
  std::uniform_real_distribution<> unit(-1.0, 1.0);
  const std::vector<Body> bodies = cage(1.0, 0.05, 0.05);
  const Spine a = make_spine(bodies);
  const Body ring = torus(0.6, 0.02, 0.02, Vec3::Zero());
  const Spine b = make_spine(std::vector<Body>{ring});
  const auto polygon = [](const Spine& s, const SpineLoop& loop, const Pose& pose) {
    std::vector<Vec3> out;
    for (const auto& [piece, sense] : loop.pieces) {
      std::vector<Vec3> corners = s.pieces[piece];
      if (sense < 0) std::reverse(corners.begin(), corners.end());
      for (std::size_t k = 0; k + 1 < corners.size(); ++k)
        out.emplace_back(pose.position + pose.rotation * corners[k]);
    }
    return out;
  };
  int linked = 0, apart = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose pose = at(1.2 * Vec3(unit(random), unit(random), unit(random)),
                         Vec3(unit(random), unit(random), unit(random)), pi * unit(random));
    bool overlap = false;
    for (const Body& body : bodies)
      overlap = overlap || separation(body, Pose{}, ring, pose, 0.0, 1e-3).upper < 1e-3;
    if (overlap) continue;
    ++apart;
    const Eigen::MatrixXi numbers = linking_numbers(a, Pose{}, b, pose);
    const std::vector<Vec3> other = polygon(b, b.cores[0], pose);
    for (std::size_t l = 0; l < a.loops.size(); ++l) {
      const int gauss = linking_of_polygons(polygon(a, a.loops[l], Pose{}), other);
      EXPECT_EQ(numbers(static_cast<Eigen::Index>(a.cores.size() + l), 0), gauss) << k;
      linked += gauss != 0;
    }
    for (std::size_t c = 0; c < bodies.size(); ++c)
      EXPECT_EQ(linking_of_polygons(polygon(a, a.cores[c], Pose{}), other),
                linking_number(bodies[c], Pose{}, ring, pose))
          << k;
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(linked, 50);
}

}  // namespace
}  // namespace hauberk
