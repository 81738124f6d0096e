/// Tubes around splines: the spline itself, distances against many balls, derivatives against differences,
/// bounds against samples, the reach against brute force, a ring against its closed form, and what is
/// refused.

#include "../spline_tube.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Nodes of a circle in a tilted plane.
std::vector<double> circle(int n, double R, double r)
{
  std::vector<double> nodes;
  for (int k = 0; k < n; ++k) {
    const double u = turn * k / n;
    for (const double x : {R * std::cos(u), 0.8 * R * std::sin(u), 0.6 * R * std::sin(u), r})
      nodes.push_back(x);
  }
  return nodes;
}

/// A trefoil of uneven thickness, a bent oval with a thick end, and an uneven loop of few nodes.
std::vector<std::vector<double>> tubes()
{
  std::vector<double> trefoil, oval;
  for (int k = 0; k < 15; ++k) {
    const double u = turn * k / 15;
    for (const double x : {std::sin(u) + 2.0 * std::sin(2.0 * u), std::cos(u) - 2.0 * std::cos(2.0 * u),
                           -std::sin(3.0 * u), 0.35 + 0.1 * std::cos(2.0 * u)})
      trefoil.push_back(x);
  }
  for (int k = 0; k < 9; ++k) {
    const double u = turn * k / 9;
    for (const double x :
         {3.0 * std::cos(u), 2.0 * std::sin(u), 0.7 * std::cos(2.0 * u), 0.35 + 0.15 * std::cos(u)})
      oval.push_back(x);
  }
  return {trefoil, oval, {2.0, 0.1, 0.3, 0.5, 0.2, 1.8, -0.2, 0.4, -2.1, 0.0, 0.4, 0.6, 0.1, -2.2, 0.0, 0.3}};
}

std::shared_ptr<const SplineSolid> made(const std::vector<double>& nodes)
{
  auto solid = std::make_shared<const SplineSolid>(nodes, carried_reference(nodes));
  EXPECT_EQ(solid->problem(), "");
  return solid;
}

BallSpline spline_of(const std::vector<double>& nodes)
{
  std::vector<BallSpline::Point> points;
  for (std::size_t k = 0; k < nodes.size(); k += 4)
    points.emplace_back(nodes[k], nodes[k + 1], nodes[k + 2], nodes[k + 3]);
  return {CardinalSpline(static_cast<int>(points.size())), points};
}

ProbeAngles angles(double u, double v) { return {std::cos(u), std::sin(u), std::cos(v), std::sin(v)}; }

/// The least |x - c| - r over many balls, and then over many near the best.
double by_many_balls(const BallSpline& spline, const Vec3& x)
{
  const auto value = [&](double t) {
    const BallSpline::Point p = spline.at(t)[0];
    return (x - p.head<3>()).norm() - p[3];
  };
  double best = std::numeric_limits<double>::infinity(), at = 0.0, width = spline.period();
  for (int level = 0; level < 4; ++level) {
    const int n = level == 0 ? 4000 : 400;
    const double middle = at, from = middle - 0.5 * width;
    for (int k = 0; k <= n; ++k) {
      const double t = from + width * k / n;
      if (value(t) < best) best = value(t), at = t;
    }
    width *= 4.0 / n;
  }
  return best;
}

TEST(SplineTube, SplinePassesItsNodesWithFourContinuousDerivatives)
{
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const int n : {3, 4, 5, 8, 17, 64}) {
    const CardinalSpline basis(n);
    std::vector<Eigen::Vector2d> nodes;
    for (int k = 0; k < n; ++k) nodes.emplace_back(uniform(rng), uniform(rng));
    const PeriodicSpline<2> spline(basis, nodes);
    for (int k = 0; k < n; ++k) {
      const auto left = spline.at(k, 1.0), right = spline.at((k + 1) % n, 0.0);
      EXPECT_LE((left[0] - nodes[static_cast<std::size_t>((k + 1) % n)]).norm(), 1e-13) << n;
      for (std::size_t order = 0; order <= 4; ++order)
        EXPECT_LE((left[order] - right[order]).norm(), 1e-10) << n << " " << order;
    }
  }
}

TEST(SplineTube, SplineIsOffByTheSixthPowerOfItsStep)
{
  const auto error = [](int count) {
    std::vector<Eigen::Vector2d> wave;
    for (int k = 0; k < count; ++k) wave.emplace_back(std::cos(turn * k / count), std::sin(turn * k / count));
    const PeriodicSpline<2> spline(CardinalSpline(count), wave);
    double worst = 0.0;
    for (int k = 0; k < 100; ++k) {
      const double t = 0.31 + 0.01 * k, u = turn * t / count;
      worst = std::max(worst, (spline.at(t)[0] - Eigen::Vector2d(std::cos(u), std::sin(u))).norm());
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(error(16) / error(32)), 6.0, 0.3);
}

TEST(SplineTube, DistancesAreThoseFromItsBalls)
{
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> uniform(-4.0, 4.0);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    const BallSpline spline = spline_of(nodes);
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 x(uniform(rng), uniform(rng), 0.5 * uniform(rng));
      const SolidDistance d = solid->distance(x);
      EXPECT_NEAR(d.distance, by_many_balls(spline, x), 1e-11);
      EXPECT_EQ(d.at_least, d.distance);
      if (std::abs(d.distance) > 0.5 * solid->smoothness().reach || d.distance < -0.2) continue;
      // Gradient and curvatures by differences of the distance and of the normal.
      constexpr double h = 1e-5;
      const Vec3 across = d.normal.cross(d.along);
      const auto at = [&](const Vec3& y) { return solid->distance(y); };
      EXPECT_NEAR((at(x + h * d.normal).distance - at(x - h * d.normal).distance) / (2.0 * h), 1.0, 1e-8);
      EXPECT_NEAR((at(x + h * d.along).distance - at(x - h * d.along).distance) / (2.0 * h), 0.0, 1e-8);
      const Vec3 bends = (at(x + h * d.along).normal - at(x - h * d.along).normal) / (2.0 * h);
      const Vec3 other = (at(x + h * across).normal - at(x - h * across).normal) / (2.0 * h);
      EXPECT_LE((bends - d.bend_along * d.along).norm(), 1e-5 * (1.0 + std::abs(d.bend_along)));
      EXPECT_LE((other - d.bend_across * across).norm(), 1e-5 * (1.0 + d.bend_across));
      EXPECT_LE(d.bend_along, d.bend_across + 1e-12);
    }
  }
}

TEST(SplineTube, ChartLiesOnTheSurfaceAndHasItsDerivatives)
{
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> uniform(0.0, turn);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    for (int trial = 0; trial < 200; ++trial) {
      const double u = uniform(rng), v = uniform(rng), h = 1e-5;
      const ProbeDerivatives p = solid->probe(angles(u, v));
      EXPECT_NEAR(solid->distance(p.x).distance, 0.0, 1e-13);
      EXPECT_NEAR(solid->distance(p.x).normal.dot(p.u.cross(p.v).normalized()), 1.0, 1e-10);
      EXPECT_LE(p.x.norm(), solid->radius());
      const auto at = [&](double du, double dv) { return solid->probe(angles(u + du, v + dv)); };
      const auto near = [](const Vec3& a, const Vec3& b) {
        EXPECT_LE((a - b).norm(), 1e-7 * (1.0 + b.norm()));
      };
      near((at(h, 0).x - at(-h, 0).x) / (2.0 * h), p.u);
      near((at(0, h).x - at(0, -h).x) / (2.0 * h), p.v);
      near((at(h, 0).u - at(-h, 0).u) / (2.0 * h), p.uu);
      near((at(0, h).u - at(0, -h).u) / (2.0 * h), p.uv);
      near((at(0, h).v - at(0, -h).v) / (2.0 * h), p.vv);
    }
  }
}

TEST(SplineTube, BoundsHoldOverPanels)
{
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    double loosest = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
      const double u = turn * uniform(rng), v = turn * uniform(rng);
      const double hu = 0.5 * std::pow(uniform(rng), 3.0), hv = 2.0 * std::pow(uniform(rng), 3.0);
      const ProbeBounds b = solid->probe_bounds(u, v, hu, hv);
      double first = 0.0;
      for (int k = 0; k < 60; ++k) {
        const double at_u = u + hu * (2.0 * uniform(rng) - 1.0), at_v = v + hv * (2.0 * uniform(rng) - 1.0);
        const ProbeDerivatives p = solid->probe(angles(at_u, at_v));
        EXPECT_LE(p.u.norm(), b.u);
        EXPECT_LE(p.v.norm(), b.v);
        EXPECT_LE(p.uu.norm(), b.uu);
        EXPECT_LE(p.uv.norm(), b.uv);
        EXPECT_LE(p.vv.norm(), b.vv);
        first = std::max(first, p.u.norm());
        constexpr double h = 1e-4;
        const ProbeDerivatives q = solid->probe(angles(at_u + h, at_v)),
                               w = solid->probe(angles(at_u, at_v + h));
        if (std::abs(at_u + h - u) <= hu) {
          EXPECT_LE((q.uu - p.uu).norm() / h, b.uuu * (1.0 + 1e-9));
          EXPECT_LE((q.uv - p.uv).norm() / h, b.uuv * (1.0 + 1e-9));
        }
        if (std::abs(at_v + h - v) <= hv) {
          EXPECT_LE((w.uv - p.uv).norm() / h, b.uvv * (1.0 + 1e-9));
          EXPECT_LE((w.vv - p.vv).norm() / h, b.vvv * (1.0 + 1e-9));
        }
      }
      if (hu < 0.1 && hv < 0.1) loosest = std::max(loosest, b.u / first);
    }
    EXPECT_LT(loosest, 2.0);
  }
}

TEST(SplineTube, SizesMoveDistanceAndChart)
{
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    const ProbeAngles at = angles(3.0 * uniform(rng), 3.0 * uniform(rng));
    const Vec3 n = Vec3(uniform(rng), uniform(rng), uniform(rng)).normalized();
    const SolidDistance there = solid->distance(solid->probe(at).x);
    const Vec3 x = solid->probe(at).x + 0.1 * there.normal;
    std::vector<double> distance(nodes.size()), probe(nodes.size());
    solid->distance_sizes(x, distance);
    solid->probe_sizes(at, n, probe);
    constexpr double h = 1e-5;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto changed = [&](double by) {
        std::vector<double> sizes = nodes;
        sizes[k] += by;
        return solid->with_sizes(sizes);
      };
      const auto more = changed(h), less = changed(-h);
      EXPECT_NEAR((more->distance(x).distance - less->distance(x).distance) / (2.0 * h), distance[k], 1e-8);
      EXPECT_NEAR(n.dot(more->probe(at).x - less->probe(at).x) / (2.0 * h), probe[k], 1e-8);
    }
  }
}

TEST(SplineTube, SpeedBoundsHowFarTheSurfaceMoves)
{
  std::mt19937_64 rng(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    std::vector<double> sizes = nodes;
    for (double& size : sizes) size += 0.02 * uniform(rng);
    const auto other = made(sizes);
    const double speed = solid->speed(sizes);
    double farthest = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
      const ProbeAngles at = angles(3.2 * uniform(rng), 3.2 * uniform(rng));
      farthest = std::max({farthest, std::abs(other->distance(solid->probe(at).x).distance),
                           std::abs(solid->distance(other->probe(at).x).distance)});
    }
    EXPECT_LE(farthest, speed);
    EXPECT_LT(speed, 6.0 * farthest);
    // What moves farther than it reaches is not known.
    for (double& size : sizes) size *= 3.0;
    EXPECT_EQ(solid->speed(sizes), std::numeric_limits<double>::infinity());
  }
}

/// The normal curvature along a straight line that touches the surface changes as along a geodesic.
TEST(SplineTube, CurvatureChangesNoFasterThanIsStated)
{
  std::mt19937_64 rng(9);
  std::uniform_real_distribution<double> uniform(0.0, turn);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    double fastest = 0.0;
    for (int trial = 0; trial < 4000; ++trial) {
      const ProbeDerivatives p = solid->probe(angles(uniform(rng), uniform(rng)));
      const double a = uniform(rng);
      const SolidDistance at = solid->distance(p.x);
      const Vec3 w = std::cos(a) * at.along + std::sin(a) * at.normal.cross(at.along);
      const auto curvature = [&](double s) {
        const SolidDistance d = solid->distance(p.x + s * w);
        const double along = d.along.dot(w), across = d.normal.cross(d.along).dot(w);
        return d.bend_along * along * along + d.bend_across * across * across;
      };
      constexpr double h = 1e-4;
      fastest = std::max(fastest, std::abs(curvature(h) - curvature(-h)) / (2.0 * h));
    }
    EXPECT_LE(fastest, solid->smoothness().change);
    EXPECT_GE(fastest, 0.05 * solid->smoothness().change);
  }
}

/// The largest ball outside that touches at a point and holds no other: by samples of the balls of the
/// spline.
TEST(SplineTube, ReachIsThatOfTheLargestEmptyBall)
{
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> uniform(0.0, turn);
  for (const auto& nodes : tubes()) {
    const auto solid = made(nodes);
    const BallSpline spline = spline_of(nodes);
    double least = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 20000; ++trial) {
      const ProbeDerivatives p = solid->probe(angles(uniform(rng), uniform(rng)));
      const Vec3 n = p.u.cross(p.v).normalized();
      for (int k = 0; k < 40 * spline.period(); ++k) {
        const BallSpline::Point b = spline.at(k / 40.0)[0];
        // |x + h n - c| = h + r
        const Vec3 way = p.x - b.head<3>();
        const double slope = n.dot(way) - b[3];
        // Balls beside the own one are those of the curvature, to a few digits.
        if (slope < -1e-3) least = std::min(least, (way.squaredNorm() - b[3] * b[3]) / (-2.0 * slope));
      }
    }
    const double reach = solid->smoothness().reach;
    EXPECT_LE(reach, least);
    EXPECT_GE(reach, 0.5 * least);
  }
}

TEST(SplineTube, ManyNodesOnACircleAreARing)
{
  constexpr double R = 5.0, r = 0.7;
  const auto solid = made(circle(48, R, r));
  EXPECT_GE(solid->smoothness().reach, 0.4 * (R - r));
  EXPECT_LE(solid->smoothness().reach, R - r + 1e-6);
  EXPECT_NEAR(solid->thickness(), r, 1e-9);
  EXPECT_GE(solid->radius(), R + r - 1e-9);
  EXPECT_LE(solid->radius(), (R + r) * 1.01);
  std::mt19937_64 rng(8);
  std::uniform_real_distribution<double> uniform(-7.0, 7.0);
  const Vec3 axis(0.0, -0.6, 0.8);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 x(uniform(rng), uniform(rng), uniform(rng));
    const double up = axis.dot(x), rho = (x - up * axis).norm();
    EXPECT_NEAR(solid->distance(x).distance, std::hypot(rho - R, up) - r, 1e-8);
  }
  const auto cores = solid->cores();
  ASSERT_EQ(cores.size(), 1U);
  for (std::size_t k = 0; k < cores[0].size(); ++k)
    EXPECT_LT(solid->distance(0.5 * (cores[0][k] + cores[0][(k + 1) % cores[0].size()])).distance, -0.4 * r);
}

TEST(SplineTube, RefusesWhatHasNoSurface)
{
  const auto message = [](const std::vector<double>& nodes, const std::vector<double>& p) -> std::string {
    try {
      SplineTube(nodes).primitives(p);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::vector<double> ring = circle(8, 3.0, 0.5);
  EXPECT_EQ(message(ring, ring), "accepted");
  std::vector<double> p = ring;
  for (std::size_t k = 3; k < p.size(); k += 4) p[k] = 3.05;  // no hole
  EXPECT_NE(message(ring, p).find("too thick for its curve"), std::string::npos) << message(ring, p);
  p = ring;
  p[3] = 2.4, p[7] = 0.05, p[11] = 2.4;
  EXPECT_NE(message(ring, p).find("the radius"), std::string::npos) << message(ring, p);
  p = ring;
  p[0] = -3.0, p[1] = p[2] = 0.1;  // the first node beside the fifth
  EXPECT_NE(message(ring, p), "accepted");
  // Turned by a right angle about an axis in its plane, the reference lies along the curve somewhere.
  p = ring;
  for (std::size_t k = 0; k < p.size(); k += 4) {
    const double u = turn * static_cast<double>(k) / static_cast<double>(p.size());
    p[k] = 0.0, p[k + 1] = 3.0 * (0.8 * std::cos(u) - 0.6 * std::sin(u)),
    p[k + 2] = 3.0 * (0.6 * std::cos(u) + 0.8 * std::sin(u));
  }
  EXPECT_NE(message(ring, p).find("turned too far"), std::string::npos) << message(ring, p);
}

}  // namespace
}  // namespace hauberk
