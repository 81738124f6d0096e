#include "solids.hpp"

#include <hauberk/error.hpp>
#include <hauberk/kit/solid_shape.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hauberk::test {
namespace {

using kit::ImplicitSolid;
using kit::turn;

constexpr double pi = std::numbers::pi;

ProbeAngles angles(double u, double v) { return {std::cos(u), std::sin(u), std::cos(v), std::sin(v)}; }

struct Random {
  std::mt19937_64 rng{3};
  double operator()(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(rng);
  }
  Vec3 in_cube(double half) { return {(*this)(-half, half), (*this)(-half, half), (*this)(-half, half)}; }
};

double torus_distance(const Vec3& x, double R, double r)
{
  return std::hypot(std::hypot(x.x(), x.y()) - R, x.z()) - r;
}

/// The largest derivative of the normal curvature along unit tangents, by its formula.
template <class Author>
double sampled_change(const std::vector<double>& q, double u, double v)
{
  const Vec3 x = kit::chart_point<Author>(turn(u), turn(v), q.data());
  const auto f = kit::field_jet<Author, 3>(x, q.data());
  const Vec3 gradient(f.derivative(0), f.derivative(1), f.derivative(2));
  const double g = gradient.norm();
  const Mat3 frame = kit::frame_of(gradient / g);
  double most = 0.0;
  for (int k = 0; k < 36; ++k) {
    const Vec3 w = std::cos(pi * k / 36.0) * frame.col(0) + std::sin(pi * k / 36.0) * frame.col(1);
    double third = 0.0, second = 0.0, mixed = 0.0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        second += f.derivative(a, b) * w[a] * w[b];
        mixed += f.derivative(a, b) * w[a] * frame(b, 2);
        for (int c = 0; c < 3; ++c) third += f.derivative(a, b, c) * w[a] * w[b] * w[c];
      }
    most = std::max(most, std::abs(third / g - 3.0 * mixed * second / (g * g)));
  }
  return most;
}

struct Sampled {
  double convex = 0.0, change = 0.0, radius = 0.0;
  double reach = std::numeric_limits<double>::infinity();
};

/// Of a surface of revolution about z whose balls are tried at u = 0 alone, unless `all`.
template <class Author>
Sampled sampled(const std::vector<double>& q, bool all)
{
  const ImplicitSolid<Author> solid(q);
  constexpr int n = 96;
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  Sampled s;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2.0 * pi * i / n, v = 2.0 * pi * j / n;
      points.push_back(solid.surface_point(angles(u, v)));
      s.radius = std::max(s.radius, points.back().norm());
      const kit::FieldAt f(kit::field_jet<Author, 2>(points.back(), q.data()));
      const SolidDistance d = kit::level_surface(f);
      normals.push_back(d.normal);
      s.convex = std::max(s.convex, d.bend_along);
      if (!kit::Statements<Author>::curvature_jumps && (all || i == 0))
        s.change = std::max(s.change, sampled_change<Author>(q, u, v));
    }
  for (int i = 0; i < (all ? n * n : n); ++i)
    for (int j = 0; j < n * n; ++j) {
      const Vec3 d = points[j] - points[i];
      const double height = d.dot(normals[i]);
      if (height > 1e-9) s.reach = std::min(s.reach, 0.5 * d.squaredNorm() / height);
    }
  return s;
}

template <class Author>
void expect_smoothness(const std::vector<double>& q, bool all = false)
{
  const Sampled exact = sampled<Author>(q, all);
  const ImplicitSolid<Author> solid(q);
  const SolidSmoothness s = solid.smoothness();
  EXPECT_GE(s.convex, exact.convex);
  EXPECT_LE(s.convex, 1.25 * exact.convex);
  EXPECT_GE(s.change, exact.change);
  EXPECT_LE(s.change, 1.5 * exact.change);
  EXPECT_LE(s.reach, exact.reach);
  EXPECT_GE(s.reach, 0.8 * exact.reach);
  EXPECT_GE(solid.radius(), exact.radius);
  EXPECT_LE(solid.radius(), 1.02 * exact.radius);
}

TEST(ImplicitSolid, BoundsSmoothnessAboveDenseSamples)
{
  expect_smoothness<Torus>({3.0, 1.0});
  expect_smoothness<Torus>({5.0, 0.7});
  expect_smoothness<Torus>({1.2, 1.0});
  expect_smoothness<PlainTorus>({3.0, 1.0});
  expect_smoothness<RoundedRing>({4.0, 1.0, 0.8});
}

TEST(ImplicitSolid, MeansByChangeADerivativeAlongGeodesics)
{
  // x + t w - t^2/2 k n with the tangent w - t k n is a geodesic of normal curvature k to the order that
  // counts.
  const std::vector<double> q{3.0, 1.0};
  const Vec3 x = kit::chart_point<PlainTorus>(turn(0.4), turn(2.0), q.data());
  const kit::FieldAt f(kit::field_jet<PlainTorus, 2>(x, q.data()));
  const Mat3 frame = kit::frame_of(f.gradient / f.steep);
  double most = 0.0;
  for (int k = 0; k < 36; ++k) {
    const Vec3 w = std::cos(pi * k / 36.0) * frame.col(0) + std::sin(pi * k / 36.0) * frame.col(1);
    const double bend = w.dot(f.hessian_times(w)) / f.steep;
    const auto bend_at = [&](double t) {
      const Vec3 y = x + t * w - 0.5 * t * t * bend * frame.col(2), z = w - t * bend * frame.col(2);
      const kit::FieldAt g(kit::field_jet<PlainTorus, 2>(y, q.data()));
      return z.dot(g.hessian_times(z)) / g.steep;
    };
    most = std::max(most, std::abs(bend_at(1e-4) - bend_at(-1e-4)) / 2e-4);
  }
  EXPECT_NEAR(most, sampled_change<PlainTorus>(q, 0.4, 2.0), 1e-6);
  EXPECT_GT(most, 0.05);
}

TEST(ImplicitSolid, KnowsConvexSolids)
{
  for (const SolidSmoothness& s : {ImplicitSolid<Capsule>({2.0, 1.0}).smoothness(),
                                   ImplicitSolid<Ellipsoid>({3.0, 2.0, 1.0}).smoothness()})
    EXPECT_EQ(s.reach, std::numeric_limits<double>::infinity());
  const SolidSmoothness capsule = ImplicitSolid<Capsule>({2.0, 1.0}).smoothness();
  EXPECT_EQ(capsule.change, std::numeric_limits<double>::infinity());
  EXPECT_GE(capsule.convex, 1.0);
  EXPECT_LE(capsule.convex, 1.25);
  const Sampled exact = sampled<Ellipsoid>({3.0, 2.0, 1.0}, true);
  const SolidSmoothness s = ImplicitSolid<Ellipsoid>({3.0, 2.0, 1.0}).smoothness();
  EXPECT_GE(s.change, exact.change);
  EXPECT_LE(s.change, 1.5 * exact.change);
  EXPECT_GE(s.convex, 3.0);  // a/c^2
  EXPECT_LE(s.convex, 3.3);
}

/// An author who is wrong about convexity.
struct StatedConvex : PlainTorus {
  static constexpr bool convex = true;
};

TEST(ImplicitSolid, DoesNotBelieveThatATorusIsConvex)
{
  EXPECT_LE(ImplicitSolid<StatedConvex>({3.0, 1.0}).smoothness().reach, 2.0);
}

/// Authors who know that u turns their charts, and one who is wrong about it.
struct RevolvedTorus : PlainTorus {
  static constexpr bool revolved = true;
};
struct StatedRevolved : Ellipsoid {
  static constexpr bool revolved = true;
};

TEST(ImplicitSolid, TakesOneMeridianOfARevolvedSurfaceForAll)
{
  const ImplicitSolid<PlainTorus> plain({3.0, 1.0});
  const ImplicitSolid<RevolvedTorus> revolved({3.0, 1.0});
  const SolidSmoothness a = plain.smoothness(), b = revolved.smoothness();
  EXPECT_NEAR(b.convex, a.convex, 0.1 * a.convex);
  EXPECT_NEAR(b.reach, a.reach, 0.1 * a.reach);
  EXPECT_NEAR(b.change, a.change, 0.25 * a.change);
  Random random;
  for (int k = 0; k < 100; ++k) {
    const double u = random(0.0, 7.0), v = random(0.0, 7.0), half = random(1e-3, 1.0);
    const ProbeBounds p = plain.probe_bounds(u, v, half, half), q = revolved.probe_bounds(u, v, half, half);
    EXPECT_NEAR(q.u, p.u, 0.05 * p.u);
    EXPECT_NEAR(q.vvv, p.vvv, 0.05 * p.vvv);
  }
  const std::vector<double> sizes{3.0, 2.0, 1.0};
  EXPECT_FALSE(kit::ChartDomain::of<StatedRevolved>(sizes.data()).revolved);
  EXPECT_EQ(ImplicitSolid<StatedRevolved>(sizes).smoothness().convex,
            ImplicitSolid<Ellipsoid>(sizes).smoothness().convex);
}

/// The largest distance of points of either solid's surface from the other.
template <class Author>
double moved(const std::vector<double>& from, const std::vector<double>& to)
{
  const ImplicitSolid<Author> a(from), b(to);
  double most = 0.0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const ProbeAngles at = angles(pi * i / 20.0, pi * j / 20.0);
      most = std::max({most, std::abs(a.distance(b.surface_point(at)).distance),
                       std::abs(b.distance(a.surface_point(at)).distance)});
    }
  return most;
}

TEST(ImplicitSolid, BoundsHowFarItsSurfaceMovesToOtherSizes)
{
  const auto check = [](auto author, const std::vector<double>& from, const std::vector<double>& to,
                        double most_slack) {
    using Author = decltype(author);
    const double speed = ImplicitSolid<Author>(from).speed(to), farthest = moved<Author>(from, to);
    EXPECT_GE(speed, farthest);
    EXPECT_LE(speed, most_slack * farthest) << Author::kind;
  };
  // Of a torus |dR| + |dr| at the outside.
  EXPECT_NEAR(ImplicitSolid<PlainTorus>({3.0, 1.0}).speed(std::vector{3.2, 1.1}), 0.3, 0.012);
  check(PlainTorus{}, {3.0, 1.0}, {3.2, 1.1}, 1.04);
  check(RevolvedTorus{}, {3.0, 1.0}, {2.6, 0.5}, 2.5);  // points move along the surface, too
  check(Ellipsoid{}, {3.0, 2.0, 1.0}, {3.0, 2.0, 1.3}, 1.02);
  check(Capsule{}, {2.0, 1.0}, {2.2, 1.0}, 1.1);
  check(RoundedRing{}, {4.0, 1.0, 0.8}, {4.0, 1.2, 0.7}, 1.6);
  EXPECT_EQ(ImplicitSolid<PlainTorus>({3.0, 1.0}).speed(std::vector{3.0, 1.0}), 0.0);
}

TEST(ImplicitSolid, BoundsReachByTheTorusHole)
{
  for (const auto& [R, r] : {std::pair{3.0, 1.0}, {5.0, 0.7}, {1.2, 1.0}}) {
    const double reach = ImplicitSolid<Torus>({R, r}).smoothness().reach;
    EXPECT_LE(reach, R - r);
    EXPECT_GE(reach, 0.8 * (R - r));
  }
}

/// Distance, normal and principal curvatures against a torus's closed forms.
template <class Author>
void expect_torus(double rounding, double bend_rounding)
{
  const double R = 3.0, r = 1.0;
  const ImplicitSolid<Author> solid({R, r});
  Random random;
  int tried = 0;
  while (tried < 3000) {
    const Vec3 x = random.in_cube(4.5);
    const double rho = std::hypot(x.x(), x.y()), d = torus_distance(x, R, r);
    if (rho < 0.3 || d < -0.9) continue;
    ++tried;
    const SolidDistance s = solid.distance(x);
    ASSERT_NEAR(s.distance, d, rounding) << x.transpose();
    EXPECT_LE(s.at_least, d + rounding);
    if (d < 0.8 * (R - r)) {
      EXPECT_EQ(s.at_least, s.distance) << x.transpose();
    }
    const double c = (rho - R) / (d + r);
    const Vec3 normal(c * x.x() / rho, c * x.y() / rho, x.z() / (d + r)),
        around(-x.y() / rho, x.x() / rho, 0.0);
    EXPECT_LE((s.normal - normal).norm(), rounding);
    // Of the parallel torus through x: 1/(r + d) along the section, cos v/rho around the axis.
    const Vec3 section = normal.cross(around);
    const double along = 1.0 / (r + d), across = c / rho, part = s.along.dot(section);
    EXPECT_NEAR(s.along.norm(), 1.0, 1e-14);
    EXPECT_NEAR(s.along.dot(s.normal), 0.0, 1e-14);
    EXPECT_NEAR(s.bend_along * part * part + s.bend_across * (1.0 - part * part), along, bend_rounding);
    EXPECT_NEAR(s.bend_along + s.bend_across, along + across, bend_rounding);
    EXPECT_NEAR(s.bend_along * s.bend_across, along * across, bend_rounding * 10.0);
  }
}

TEST(ImplicitSolid, HasATorusClosedForms)
{
  expect_torus<Torus>(1e-13, 1e-11);
  expect_torus<PlainTorus>(1e-12, 1e-10);
}

TEST(ImplicitSolid, HasCurvaturesOnTheSurface)
{
  const ImplicitSolid<PlainTorus> solid({3.0, 1.0});
  for (int k = 0; k < 50; ++k) {
    const double v = 0.13 * k, u = 0.37 * k;
    const SolidDistance s = solid.distance(solid.surface_point(angles(u, v)));
    EXPECT_NEAR(s.distance, 0.0, 1e-14);
    EXPECT_NEAR(s.bend_along, 1.0, 1e-12);
    EXPECT_NEAR(s.bend_across, std::cos(v) / (3.0 + std::cos(v)), 1e-12);
  }
}

/// Feet of points that leave the surface along its normal, and bounds of far ones, against sampled points.
template <class Author>
void expect_distance(const std::vector<double>& q, double outside, double inside)
{
  const ImplicitSolid<Author> solid(q);
  Random random;
  for (int k = 0; k < 3000; ++k) {
    const Vec3 y = solid.surface_point(angles(random(0.0, 2.0 * pi), random(0.0, 2.0 * pi)));
    const Vec3 n = kit::FieldAt(kit::field_jet<Author, 2>(y, q.data())).gradient.normalized();
    const double d = random(-inside, outside);
    const SolidDistance s = solid.distance(y + d * n);
    ASSERT_NEAR(s.distance, d, 1e-12) << y.transpose() << " " << d;
    EXPECT_LE((s.normal - n).norm(), 1e-10);
    EXPECT_EQ(s.at_least, s.distance);
  }
  std::vector<Vec3> surface;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) surface.push_back(solid.surface_point(angles(pi * i / 30.0, pi * j / 30.0)));
  for (int k = 0; k < 1000; ++k) {
    const Vec3 x = random.in_cube(2.5 * solid.radius());
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& y : surface) nearest = std::min(nearest, (x - y).norm());
    const SolidDistance s = solid.distance(x);
    EXPECT_LE(s.at_least, s.distance);
    EXPECT_LE(s.at_least, s.at_least < 0.0 ? 0.0 : nearest + 1e-12) << x.transpose();
    EXPECT_TRUE(std::isfinite(s.distance) && std::isfinite(s.at_least));
    // Where no foot is certain balls tell, which are small beside the distance.
    if (s.distance <= 0.0) continue;
    EXPECT_GE(s.at_least, 0.9 * nearest - 0.1 * solid.radius()) << x.transpose();
  }
}

TEST(ImplicitSolid, FindsFeetWhereTheyAreCertain)
{
  expect_distance<PlainTorus>({3.0, 1.0}, 1.6, 0.9);
  expect_distance<Ellipsoid>({3.0, 2.0, 1.0}, 5.0, 0.2);
  expect_distance<RoundedRing>({4.0, 1.0, 0.8}, 2.0, 0.2);
}

/// A torus whose section leaves the half plane u = 0.
struct TwistedTorus {
  static constexpr const char* kind = "test_twisted_torus";
  static constexpr std::array size_names{"R", "r"};
  static constexpr bool revolved = true;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    // Turned by an angle whose half has the tangent 1/5 sin v.
    const S t = 0.2 * v.s, by = 1.0 / (1.0 + t * t), c = (1.0 - t * t) * by, s = 2.0 * t * by;
    return Torus::chart(Turn<S>{u.c * c - u.s * s, u.s * c + u.c * s}, v, q);
  }
};

/// An ellipsoid with poles on the axis z, which v runs over twice.
struct Spheroid {
  static constexpr const char* kind = "test_spheroid";
  static constexpr std::array size_names{"a", "c"};
  static constexpr bool revolved = true;

  template <class S>
  static Point<S> chart(const Turn<S>& u, const Turn<S>& v, const S* q)
  {
    const S rho = q[0] * v.s;
    return {rho * u.c, rho * u.s, q[1] * v.c};
  }
};

/// Segments along a section bound the distance of the surface, to two hundredths of it and `loose`, or as far
/// as asked.
template <class Author>
void expect_segments(const std::vector<double>& q, double loose = 0.0)
{
  using Vec2 = Eigen::Vector2d;
  const kit::ChartBounds<kit::Chart<Author, false>> chart(q.data());
  const kit::SectionSegments<Author> segments(q.data(), chart);
  constexpr int samples = 4000;
  constexpr double missed = 2e-5;  // by chords between samples
  const auto turned = [](const Vec3& x) { return Vec2(std::hypot(x.x(), x.y()), x.z()); };
  std::vector<Vec3> section;
  for (int k = 0; k <= samples; ++k)
    section.push_back(kit::chart_point<Author>(turn(0.0), turn(2.0 * pi * k / samples), q.data()));
  Random random;
  for (int k = 0; k < 2000; ++k) {
    Vec3 x = k < 20 ? Vec3(0.0, 0.0, 0.4 * k - 4.0) : random.in_cube(2.5 * (q[0] + q[1]));
    if (k % 2 == 0 && k >= 20)  // near the surface
      x = section[static_cast<std::size_t>(random(0.0, samples))] + random.in_cube(k % 4 == 0 ? 0.05 : 0.005);
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < samples; ++i) {
      const Vec2 from = turned(section[i]), along = turned(section[i + 1]) - from, away = turned(x) - from;
      const double at = std::clamp(away.dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
      nearest = std::min(nearest, (away - at * along).norm());
    }
    const kit::BallDistance whole = segments.of(x, std::numeric_limits<double>::infinity());
    ASSERT_LE(whole.at_least, nearest + missed) << x.transpose();
    ASSERT_GE(whole.at_least, 0.98 * nearest - missed - loose) << x.transpose();
    EXPECT_GE(whole.distance, nearest - missed);
    EXPECT_NEAR((x - whole.near).norm(), whole.distance, 1e-12 * (1.0 + whole.distance));
    EXPECT_LE(whole.distance, nearest / 0.98 + missed + 2e-3);  // the finest parts' middles are as far apart
    const kit::BallDistance some = segments.of(x, 0.5 * nearest);
    EXPECT_LE(some.at_least, nearest + missed);
    EXPECT_GE(some.at_least, 0.5 * nearest - missed - loose);
  }
}

TEST(SectionSegments, BoundTheDistance)
{
  expect_segments<Torus>({3.0, 1.0});
  expect_segments<Spheroid>({2.0, 1.0});
  expect_segments<RoundedRing>({4.0, 1.0, 0.8});
  expect_segments<TwistedTorus>({3.0, 1.0}, 2e-3);  // balls alone, as its section is in no half plane
}

TEST(ImplicitSolid, StaysFiniteWhereTheFieldHasNoDerivative)
{
  for (const Vec3& x : {Vec3(0.0, 0.0, 0.0), Vec3(3.0, 0.0, 0.0), Vec3(0.0, 0.0, 2.0)}) {
    const SolidDistance s = ImplicitSolid<Torus>({3.0, 1.0}).distance(x);
    EXPECT_NEAR(s.distance, torus_distance(x, 3.0, 1.0), 1e-12);
    EXPECT_NEAR(s.normal.norm(), 1.0, 1e-12);
    EXPECT_TRUE(std::isfinite(ImplicitSolid<PlainTorus>({3.0, 1.0}).distance(x).distance));
  }
  EXPECT_NEAR(ImplicitSolid<Capsule>({2.0, 1.0}).distance({0.0, 0.0, 0.5}).distance, -1.0, 1e-12);
  EXPECT_TRUE(std::isfinite(ImplicitSolid<Ellipsoid>({3.0, 2.0, 1.0}).distance({0.0, 0.0, 0.0}).distance));
}

/// Derivatives of a probe against differences, and bounds above samples in panels, tight in the median.
template <class Author>
void expect_probe(const std::vector<double>& q)
{
  const ImplicitSolid<Author> solid(q);
  const Solid& s = solid;
  Random random;
  const bool curve = s.probe_dimension() == 1;
  std::vector<double> slack;
  for (int k = 0; k < 1000; ++k) {
    const double u = random(-10.0, 10.0), v = random(-10.0, 10.0), half = random(0.05, 1.5);
    const ProbeBounds b = s.probe_bounds(u, v, half, half);
    ProbeBounds most;
    for (int t = 0; t < 100; ++t) {
      const double at_u = u + random(-half, half), at_v = v + random(-half, half), h = 1e-5;
      const ProbeDerivatives p = s.probe(angles(at_u, at_v));
      const ProbeDerivatives pu = s.probe(angles(at_u + h, at_v)), pv = s.probe(angles(at_u, at_v + h));
      const double size = 1.0 + p.u.norm() + p.uu.norm() + p.vv.norm();
      EXPECT_LE((0.5 / h * (pu.x - s.probe(angles(at_u - h, at_v)).x) - p.u).norm(), 1e-8 * size);
      EXPECT_LE(((pu.u - p.u) / h - p.uu).norm(), 1e-3 * size);
      EXPECT_LE(((pu.v - p.v) / h - p.uv).norm(), 1e-3 * size);
      EXPECT_LE(((pv.v - p.v) / h - p.vv).norm(), 1e-3 * size);
      most = kit::larger(
          most, {p.u.norm(), p.v.norm(), p.uu.norm(), p.uv.norm(), p.vv.norm(), ((pu.uu - p.uu) / h).norm(),
                 ((pu.uv - p.uv) / h).norm(), ((pv.uv - p.uv) / h).norm(), ((pv.vv - p.vv) / h).norm()});
    }
    const auto compare = [&](double bound, double value, double rounding) {
      EXPECT_GE(bound, value - rounding) << u << " " << v << " " << half;
      if (value > 0.05 && half > 0.4) slack.push_back(bound / value);
    };
    compare(b.u, most.u, 1e-12), compare(b.uu, most.uu, 1e-12), compare(b.uuu, most.uuu, 1e-3);
    if (curve) continue;
    compare(b.v, most.v, 1e-12), compare(b.uv, most.uv, 1e-12), compare(b.vv, most.vv, 1e-12);
    compare(b.uuv, most.uuv, 1e-3), compare(b.uvv, most.uvv, 1e-3), compare(b.vvv, most.vvv, 1e-3);
  }
  std::nth_element(slack.begin(), slack.begin() + slack.size() / 2, slack.end());
  EXPECT_LE(slack[slack.size() / 2], 1.2);
}

TEST(ImplicitSolid, BoundsProbesOverPanels)
{
  expect_probe<Torus>({3.0, 1.0});
  expect_probe<Capsule>({2.0, 1.0});
  expect_probe<PlainTorus>({3.0, 1.0});
  expect_probe<RoundedRing>({4.0, 1.0, 0.8});
  expect_probe<Ellipsoid>({3.0, 2.0, 1.0});
}

TEST(ImplicitSolid, KeepsAProbeAtItsOffset)
{
  Random random;
  for (int k = 0; k < 200; ++k) {
    const ProbeAngles at = angles(random(0.0, 2.0 * pi), random(0.0, 2.0 * pi));
    const ImplicitSolid<Torus> torus({3.0, 1.0});
    const ImplicitSolid<Capsule> capsule({2.0, 1.0});
    EXPECT_NEAR(capsule.distance(capsule.surface_point(at)).distance, 0.0, 1e-13);
    EXPECT_NEAR(torus.distance(torus.surface_point(at)).distance, 0.0, 1e-13);
    EXPECT_EQ(capsule.offset(), 1.0);
    EXPECT_NEAR(capsule.distance(capsule.probe(at).x + Vec3(1e-7, 0, 0)).distance, -1.0, 1e-6);
    const ProbeAngles twin{-at.cos_u, -at.sin_u, at.cos_v, -at.sin_v};  // the chart folds at poles
    EXPECT_LE((capsule.surface_point(at) - capsule.surface_point(twin)).norm(), 1e-14);
  }
}

/// Derivatives by sizes against central differences of whole solids.
template <class Author>
void expect_sizes(const std::vector<double>& q)
{
  const ImplicitSolid<Author> solid(q);
  Random random;
  std::vector<double> by_distance(q.size()), by_probe(q.size());
  for (int k = 0; k < 12; ++k) {
    const ProbeAngles at = angles(random(0.0, 2.0 * pi), random(0.0, 2.0 * pi));
    const Vec3 x = solid.surface_point(at) * random(1.0, 1.2), n = random.in_cube(1.0).normalized();
    solid.distance_sizes(x, by_distance);
    solid.probe_sizes(at, n, by_probe);
    for (std::size_t i = 0; i < q.size(); ++i) {
      constexpr double h = 3e-6;
      std::vector<double> more = q, less = q;
      more[i] += h, less[i] -= h;
      const ImplicitSolid<Author> a(more), b(less);
      EXPECT_NEAR(by_distance[i], (a.distance(x).distance - b.distance(x).distance) / (2.0 * h), 1e-7);
      const double moved = n.dot(a.probe(at).x - b.probe(at).x) - (a.offset() - b.offset());
      EXPECT_NEAR(by_probe[i], moved / (2.0 * h), 1e-8);
    }
  }
}

TEST(ImplicitSolid, HasDerivativesBySizes)
{
  expect_sizes<Torus>({3.0, 1.0});
  expect_sizes<PlainTorus>({3.0, 1.0});
  expect_sizes<Capsule>({2.0, 1.0});
  expect_sizes<Ellipsoid>({3.0, 2.0, 1.0});
  expect_sizes<RoundedRing>({4.0, 1.0, 0.8});
}

/// An oval ring as its own shape, which does not say that it is revolved.
struct FlatRing : OvalRing {
  static constexpr bool revolved = false;

  static std::vector<ParameterInfo> parameters()
  {
    return {{"R", "length", 5.0, 1e-9, 1e9, "radius"},
            {"w", "length", 0.7, 1e-9, 1e9, "half the width"},
            {"h", "length", 0.3, 1e-9, 1e9, "half the height"}};
  }
};

/// The tips of its section bend most, by w/h^2.
TEST(SolidShape, BoundsTheCurvatureOfFlatSectionsOrRefusesThemByName)
{
  const kit::SolidShape<FlatRing> shape("ring");
  for (const double h : {0.5, 0.2, 0.1, 0.05}) {
    const double thickness = shape.primitives(std::vector{5.0, 0.7, h}).at(0).r0(), exact = h * h / 0.7;
    EXPECT_LE(thickness, exact * (1.0 + 1e-9)) << h;
    EXPECT_GE(thickness, 0.5 * exact) << h;
  }
  std::string message;
  try {
    static_cast<void>(shape.primitives(std::vector{5.0, 0.7, 1e-4}));
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(
      message,
      "primitive 'ring', of kind test_oval_ring with 'R' = 5, 'w' = 0.7, 'h' = 0.0001, bends so sharply that "
      "no bound of its curvature was found; make it less thin or flat");
}

TEST(ImplicitSolid, TellsWhatItIs)
{
  const ImplicitSolid<Torus> torus({3.0, 1.0});
  EXPECT_EQ(torus.kind(), "test_torus");
  EXPECT_EQ(torus.size_names(), (std::vector<std::string>{"R", "r"}));
  EXPECT_EQ(torus.probe_dimension(), 1);
  EXPECT_EQ(ImplicitSolid<PlainTorus>({3.0, 1.0}).probe_dimension(), 2);
  EXPECT_EQ(ImplicitSolid<Capsule>({3.0, 1.0}).fold(), Fold::mirror);
  EXPECT_EQ(torus.cores().front().size(), 12u);
  EXPECT_THROW(ImplicitSolid<Torus>({3.0}), std::invalid_argument);
  EXPECT_THROW(ImplicitSolid<Torus>({3.0, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace hauberk::test
