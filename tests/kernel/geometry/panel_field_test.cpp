/// Distances from an ellipse one by one and four at a time, and panels that carry their angles along.

#include "geometry/panel_field.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

struct Numbers {
  std::mt19937_64 rng{3};

  double between(double lower, double upper)
  {
    return std::uniform_real_distribution<double>(lower, upper)(rng);
  }
};

/// Smallest distance of (x, y) to places of the ellipse, dense and then ever denser around the nearest.
double brute_force_distance(double a, double b, double x, double y)
{
  const auto to = [&](double v) { return std::hypot(a * std::cos(v) - x, b * std::sin(v) - y); };
  double nearest = 0.0, width = std::numbers::pi;
  for (int round = 0; round < 8; ++round) {
    const int count = round == 0 ? 2000 : 40;
    const double middle = nearest, step = 2.0 * width / count;
    for (int k = 0; k <= count; ++k)
      if (to(middle - width + k * step) < to(nearest)) nearest = middle - width + k * step;
    width = 2.0 * step;
  }
  return to(nearest);
}

TEST(EllipseDistances, EqualThoseOneByOneAndABruteForceSearch)
{
  Numbers random;
  int on_axes = 0, inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = std::pow(10.0, random.between(-1.0, 0.0));
    const double b = a * std::pow(30.0, random.between(-1.0, 1.0));
    std::array<double, 4> x{}, y{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double size = std::max(a, b) * std::pow(10.0, random.between(-3.0, 1.0));
      x[k] = i % 10 == 1 && k < 2 ? 0.0 : size * random.between(-1.0, 1.0);
      y[k] = i % 10 == 2 && k < 2 ? 0.0 : size * random.between(-1.0, 1.0);
      if (i % 500 == 1 && k == 0) y[k] = 0.0;  // the centre
    }
    const std::array<MeridianDistance, 4> four = ellipse_distances(a, b, x, y);
    const std::array<MeridianDistance, 2> two =
        ellipse_distances(a, b, std::array{x[0], x[1]}, std::array{y[0], y[1]});
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(two[k].phi, four[k].phi, 4e-15 * std::max(a, b) + 4e-16 * std::hypot(x[k], y[k])) << i;
    for (std::size_t k = 0; k < 4; ++k) {
      const MeridianDistance one = ellipse_distance(a, b, x[k], y[k]);
      const double size = std::max({a, b, std::abs(x[k]), std::abs(y[k])});
      EXPECT_NEAR(four[k].phi, one.phi, 4e-15 * size);
      // Beyond the medial axis, and on it, the closest point is not the only one.
      const double bend = std::min(a * a / b, b * b / a);
      inside += four[k].phi < 0.0 ? 1 : 0;
      on_axes += x[k] == 0.0 || y[k] == 0.0 ? 1 : 0;
      if (four[k].phi > -0.3 * bend) {
        EXPECT_NEAR(four[k].nr, one.nr, 1e-12);
        EXPECT_NEAR(four[k].nz, one.nz, 1e-12);
        EXPECT_NEAR(four[k].k, one.k, 1e-11 * std::abs(one.k));
        EXPECT_NEAR(four[k].c, one.c, 1e-11);
        EXPECT_NEAR(four[k].s, one.s, 1e-11);
      }
      if (i % 20 < 3) {
        const double distance = brute_force_distance(a, b, x[k], y[k]);
        EXPECT_NEAR(std::abs(four[k].phi), distance, 1e-12 * size)
            << a << " " << b << " " << x[k] << " " << y[k];
      }
    }
  }
  EXPECT_GT(on_axes, 1000);
  EXPECT_GT(inside, 1000);
}

TEST(FieldsAt, EqualFieldsOneByOneForAnyNumberOfPoints)
{
  Numbers random;
  for (const double high : {0.2, 0.35}) {
    Primitive p;
    p.kind = high == 0.2 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
    p.size = {1.0, 0.2, high};
    const Body body = make_body(p, 0, 0, 1.0);
    for (std::size_t count = 0; count <= 9; ++count) {
      std::vector<Vec3> at(count);
      std::vector<FieldValue> fields(count);
      std::vector<PointField> points(count);
      for (std::size_t k = 0; k < count; ++k) {
        at[k] = Vec3(random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-1.0, 1.0));
        points[k] = {&at[k], &fields[k]};
      }
      fields_at(body, points);
      for (std::size_t k = 0; k < count; ++k) {
        const FieldValue one = field_at(body, at[k]);
        EXPECT_NEAR(fields[k].m.phi, one.m.phi, 1e-14);
        EXPECT_NEAR((fields[k].n - one.n).norm(), 0.0, 1e-11);
        EXPECT_EQ(fields[k].rho, one.rho);
      }
    }
  }
}

/// A probe of P in F's field; frames keep pointers to both.
struct Scene {
  Body P, F;
  PairFrame frame;

  Scene(const Body& p, const Body& f, const Pose& pose) : P(p), F(f), frame(P, pose, F, Pose{}) {}
};

template <int dim>
void expect_panels_to_cover_and_to_keep_their_angles(Tiling tiling)
{
  Primitive ring;
  ring.kind = dim == 1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  ring.size = {1.0, 0.2, dim == 1 ? 0.2 : 0.3};
  Pose pose;
  pose.position = Vec3(0.9, 0.1, 0.2);
  const Scene scene(make_body(ring, 0, 0, 1.0), make_body(ring, 1, 0, 1.0), pose);
  const Probe<dim> probe(scene.frame);
  constexpr double turn = 0.1234;
  const FirstPanels<dim> first(probe, turn, tiling);
  double area = 0.0;
  Numbers random;
  for (int k = 0; k < first.rows(); ++k) {
    std::array<PanelField, 4> row = first.row(k);
    fill_fields(scene.F, row);
    for (PanelField p : row) {
      area += dim == 2 ? 4.0 * p.s.hu * p.s.hv : 2.0 * p.s.hu;
      for (int depth = 0; depth < 40; ++depth) {
        const ProbePoint exact = probe.at(p.s.u, p.s.v);
        EXPECT_NEAR((p.q.p - exact.p).norm(), 0.0, 3e-14) << depth;
        EXPECT_NEAR(p.f.m.phi, field_at(scene.F, exact.p).m.phi, 4e-14) << depth;
        const std::array<PanelField, 2> half = split(probe, p);
        EXPECT_EQ(half[0].s.hu * half[0].s.hv + half[1].s.hu * half[1].s.hv, p.s.hu * p.s.hv);
        p = half[random.between(0.0, 1.0) < 0.5 ? 0 : 1];
      }
    }
  }
  const double turns = 2.0 * std::numbers::pi;
  EXPECT_NEAR(area, dim == 2 ? turns * turns : turns, 1e-13);
}

TEST(PanelField, FirstPanelsCoverAndHalvesKeepTheirAnglesOnLines)
{
  expect_panels_to_cover_and_to_keep_their_angles<1>(Tiling::panels);
}

TEST(PanelField, FirstPanelsCoverAndHalvesKeepTheirAnglesOnSurfaces)
{
  expect_panels_to_cover_and_to_keep_their_angles<2>(Tiling::panels);
}

TEST(PanelField, StripsCoverAndFollowTheNearestPlace)
{
  Primitive ring;
  ring.kind = PrimitiveKind::revolved_ellipse;
  ring.size = {1.0, 0.2, 0.3};
  Pose pose;
  pose.position = Vec3(0.9, 0.1, 0.2);
  pose.rotation = Eigen::AngleAxisd(1.2, Vec3(1.0, 0.3, 0.0).normalized()).toRotationMatrix();
  const Scene scene(make_body(ring, 0, 0, 1.0), make_body(ring, 1, 0, 1.0), pose);
  const Probe<2> probe(scene.frame);
  const FirstPanels<2> first(probe, 0.1234);
  ASSERT_EQ(first.rows(), 2);
  double length = 0.0, off = 0.0;
  int followed = 0;
  for (int k = 0; k < first.rows(); ++k) {
    std::array<PanelField, most_together> row = first.row(k);
    fill_fields(scene.F, row);
    for (const PanelField& p : row) {
      ASSERT_TRUE(is_strip(p.s));
      length += 2.0 * p.s.hu;
      std::vector<PanelField> strips{p};
      for (int depth = 0; depth < 5; ++depth) {
        std::vector<PanelField> next;
        for (const PanelField& s : strips) {
          std::array<PanelField, 2> half = located_halves(probe, s, true);
          fill_fields(scene.F, half);
          EXPECT_TRUE(is_strip(half[0].s) && is_strip(half[1].s));
          EXPECT_NEAR(half[0].s.u + half[0].s.hu, half[1].s.u - half[1].s.hu, 1e-15);
          next.insert(next.end(), half.begin(), half.end());
        }
        strips = next;
      }
      for (const PanelField& s : strips) {
        const ProbePoint exact = probe.at(s.s.u, s.s.v);
        EXPECT_NEAR((s.q.p - exact.p).norm(), 0.0, 3e-14);
        const SecondDerivatives h = surface_hessian(probe, s.q, s.f);
        if (!(h.vv > 0.05)) continue;
        off = std::max(off, std::abs(s.f.n.dot(s.q.pv) / h.vv));
        ++followed;
      }
    }
  }
  EXPECT_NEAR(length, 2.0 * std::numbers::pi, 1e-13);
  EXPECT_GT(followed, 100);
  EXPECT_LT(off, 0.02) << "radians from the nearest place of a cross-section";
}

}  // namespace
}  // namespace hauberk::test
