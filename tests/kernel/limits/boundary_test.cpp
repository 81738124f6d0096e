/// Limits along components: the sphere of directions, equality with angles, symmetry, the support property.

#include "limits/boundary.hpp"

#include "limits/limits.hpp"
#include "scenes.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hauberk::test {
namespace {

const Sheet sheet{2};

/// (exx, eyy, sqrt(2) exy): the metric's length is the ordinary one.
Vec3 metric_vector(const Direction& d)
{
  const auto c = d.components();
  return {c[0], c[1], std::sqrt(2.0) * c[2]};
}

Direction along(std::array<double, 3> d) { return Direction::along(d); }

/// The components of a symmetric tensor turned by `angle`.
Direction turned(const Direction& direction, double angle)
{
  const auto d = direction.components();
  Eigen::Matrix2d eps;
  eps << d[0], d[2], d[2], d[1];
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Eigen::Matrix2d out = R * eps * R.transpose();
  return along({out(0, 0), out(1, 1), out(0, 1)});
}

TEST(DirectionSphere, IsAClosedSurfaceOfUnitVectorsInTheMetric)
{
  for (const int parts : {1, 2, 3, 5, 16}) {
    const DirectionSphere s = direction_sphere(parts, sheet);
    EXPECT_EQ(s.directions.size(), static_cast<std::size_t>(10 * parts * parts + 2));
    EXPECT_EQ(s.triangles.size(), static_cast<std::size_t>(20 * parts * parts));
    for (const Direction& d : s.directions) EXPECT_NEAR(metric_vector(d).norm(), 1.0, 1e-15);
    std::map<std::pair<int, int>, int> edges;
    double smallest = 1e9, largest = 0.0, solid = 0.0;
    for (const Triangle& t : s.triangles) {
      std::array<Vec3, 3> x;
      for (std::size_t k = 0; k < 3; ++k) {
        ++edges[{t[k], t[(k + 1) % 3]}];
        x[k] = metric_vector(s.directions[t[k]]);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double length = (x[k] - x[(k + 1) % 3]).norm();
        smallest = std::min(smallest, length);
        largest = std::max(largest, length);
      }
      solid += x[0].dot(x[1].cross(x[2])) / 6.0;
      EXPECT_GT(x[0].dot(x[1].cross(x[2])), 0.0) << "counter-clockwise from outside";
    }
    // Every edge is there once in each sense, so nothing is open; Euler's number of a sphere.
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
    EXPECT_EQ(s.directions.size() + s.triangles.size(), edges.size() / 2 + 2);
    EXPECT_LT(largest / smallest, 1.46) << "even";
    EXPECT_LT(solid, 4.0 / 3.0 * std::numbers::pi);
  }
}

TEST(DirectionSphere, HasTheAxesAndOppositesForEvenParts)
{
  const DirectionSphere s = direction_sphere(4, sheet);
  const auto has = [&s](const Vec3& x) {
    return std::any_of(s.directions.begin(), s.directions.end(),
                       [&x](const Direction& d) { return (metric_vector(d) - x).norm() < 1e-15; });
  };
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(has(Vec3::Unit(k)));
    EXPECT_TRUE(has(-Vec3::Unit(k)));
  }
  for (const Direction& d : s.directions) EXPECT_TRUE(has(-metric_vector(d)));
}

TEST(DirectionSphere, RefusesWhatItCannotDivide)
{
  EXPECT_THROW(direction_sphere(0, sheet), InputError);
  EXPECT_THROW(direction_sphere(most_parts + 1, sheet), InputError);
}

TEST(Directions, NeedFiniteComponentsThatAreNotAllZero)
{
  EXPECT_THROW(along({0.0, 0.0, 0.0}), InputError);
  EXPECT_THROW(along({1.0, std::nan(""), 0.0}), InputError);
  EXPECT_THROW(Direction::along({}), InputError);
  EXPECT_THROW(Direction::along(std::array<double, 7>{1.0}), InputError);
  EXPECT_EQ(along({1.0, 0.0, 1.0 / 3.0}).text(), "(1, 0, 0.333333)");
  EXPECT_EQ(Direction::at_degrees(30.0).text(), "30 degrees");
  EXPECT_TRUE(Direction().is_angle());
  EXPECT_NE(along({0.0, 0.0, 1.0}), Direction());
}

TEST(Directions, LoadIsTheMetricsAndIgnoresLength)
{
  std::array<double, 3> t{};
  sheet.load(along({3e200, 0.0, 4e200 / std::sqrt(2.0)}), t);
  EXPECT_NEAR(t[0], 0.6, 1e-15);
  EXPECT_EQ(t[1], 0.0);
  EXPECT_NEAR(t[2], 0.8 * std::sqrt(2.0), 1e-15);
  const std::array<double, 3> macro{0.1, -0.2, 0.05};
  EXPECT_NEAR(sheet.value(along({-5.0, 0.0, 0.0}), macro), -0.1, 1e-17);
  EXPECT_EQ(sheet.measure(along({1.0, 0.0, 0.0})), "metric");
  EXPECT_EQ(sheet.measure(Direction()), "tensor");
  std::array<double, 2> two{};
  EXPECT_THROW(sheet.load(along({1.0, 0.0, 0.0}), two), PluginError);
  EXPECT_THROW(sheet.load(Direction::along(two = {1.0, 2.0}), t), PluginError);
}

struct Threefold {
  SceneSpec scene = threefold_round();
  Model model = make_model(scene, sheet, 0.0);
  LimitSettings settings;

  std::vector<LimitResult> limits(const std::vector<LimitTask>& tasks) const
  {
    return compute_limits(model, scene, tasks, settings, 2);
  }
};

/// The tensor measure at theta is the unit vector (c^2, s^2, c s) of the metric; compression is its opposite.
TEST(Boundary, DirectionsOfUniaxialLoadAreThoseOfAngles)
{
  const Threefold threefold;
  std::vector<LimitTask> angles, components;
  for (const double deg : {0.0, 15.0, 30.0, 70.0, 90.0}) {
    const double c = std::cos(deg * degree), s = std::sin(deg * degree);
    for (const double sign : {1.0, -1.0}) {
      angles.push_back({Direction::at_degrees(deg), sign > 0.0 ? Sense::positive : Sense::negative});
      // Any length will do.
      components.push_back(
          {along({7.0 * sign * c * c, 7.0 * sign * s * s, 7.0 * sign * c * s}), Sense::positive});
    }
  }
  const std::vector<LimitResult> one = threefold.limits(angles), other = threefold.limits(components);
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_EQ(one[k].status, LimitStatus::locked);
    ASSERT_EQ(other[k].status, LimitStatus::locked);
    EXPECT_EQ(other[k].sense, "along");
    EXPECT_NEAR(*other[k].value, std::abs(*one[k].value), 1e-9) << angles[k].direction.text();
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(other[k].macro[i].second, one[k].macro[i].second, 1e-6) << angles[k].direction.text();
  }
}

/// The element turned by 120 degrees, and a strain turned by 180, are what they were: so 60 degrees.
TEST(Boundary, OfTheThreefoldElementHasItsSymmetry)
{
  const Threefold threefold;
  std::vector<LimitTask> tasks;
  for (const Direction& d : {along({1, 0, 0}), along({-1, -1, 0}), along({0.5, -1, 0.3}), along({0, 0, 1})}) {
    for (int k = 0; k < 3; ++k) tasks.push_back({turned(d, 60.0 * k * degree), Sense::positive});
  }
  const std::vector<LimitResult> r = threefold.limits(tasks);
  for (std::size_t k = 0; k < r.size(); ++k) {
    ASSERT_EQ(r[k].status, LimitStatus::locked) << r[k].message;
    EXPECT_NEAR(*r[k].value, *r[k - k % 3].value, 1e-8) << tasks[k].direction.text();
  }
  // And it is no sphere, so that the equalities say something.
  EXPECT_GT(std::abs(*r[0].value - *r[3].value), 1e-3);
  EXPECT_GT(std::abs(*r[3].value - *r[6].value), 1e-3);
}

TEST(Boundary, IsThatOfASupportFunction)
{
  const Threefold threefold;
  const DirectionSphere sphere = direction_sphere(2, sheet);
  std::vector<LimitTask> tasks;
  tasks.reserve(sphere.directions.size());
  for (const Direction& d : sphere.directions) tasks.push_back({d, Sense::positive});
  const std::vector<LimitResult> r = threefold.limits(tasks);
  for (const LimitResult& own : r) {
    ASSERT_EQ(own.status, LimitStatus::locked) << own.message;
    for (const LimitResult& other : r) {
      const std::array<double, 3> macro{other.macro[0].second, other.macro[1].second, other.macro[2].second};
      EXPECT_LE(sheet.value(own.direction, macro), *own.value + 1e-7);
    }
  }
  const auto boundary = boundary_surface(r, sphere.triangles, sheet, further_than(threefold.settings));
  ASSERT_TRUE(boundary);
  EXPECT_EQ(boundary->triangles, sphere.triangles);
  EXPECT_TRUE(boundary->shortfalls.empty());
}

TEST(Boundary, NamesLimitsThatAreNotTheFurthest)
{
  std::vector<LimitResult> r(4);
  const auto fill = [](LimitResult& limit, std::array<double, 3> d, double value,
                       std::array<double, 3> macro) {
    limit.direction = along(d);
    limit.status = LimitStatus::locked;
    limit.value = value;
    limit.macro = {{"exx", macro[0]}, {"eyy", macro[1]}, {"exy", macro[2]}};
  };
  fill(r[0], {1, 0, 0}, 0.10, {0.10, 0.0, 0.0});
  fill(r[1], {0, 1, 0}, 0.30, {0.12, 0.30, 0.0});
  fill(r[2], {0, 0, 1}, 0.2 * std::sqrt(2.0), {0.11, 0.0, 0.2});
  fill(r[3], {-1, 0, 0}, 0.0, {9.0, 9.0, 9.0});
  r[3].status = LimitStatus::stalled;  // its state is no evidence
  const auto boundary = boundary_surface(r, {}, sheet, 1e-3);
  ASSERT_TRUE(boundary);
  ASSERT_EQ(boundary->shortfalls.size(), 1U);
  EXPECT_EQ(boundary->shortfalls[0].limit, 0);
  EXPECT_EQ(boundary->shortfalls[0].state, 1) << "the furthest of two";
  EXPECT_NEAR(boundary->shortfalls[0].by, 0.02, 1e-15);
  EXPECT_TRUE(boundary_surface(r, {}, sheet, 0.03)->shortfalls.empty());
  EXPECT_FALSE(boundary_surface(std::vector<LimitResult>(2), {}, sheet, 1e-3)) << "angles have no boundary";
}

}  // namespace
}  // namespace hauberk::test
