/// Bounds of the distance field: never violated, and of the order that makes them worth their cost.

#include "geometry/panel_bound.hpp"
#include "geometry/strip.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

Body torus(double R, double r0, double r1)
{
  Primitive p;
  p.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  p.size = {R, r0, r1};
  return make_body(p, 0, 0, 1.0);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : rng_(seed) {}
  double between(double lower, double upper)
  {
    return std::uniform_real_distribution<double>(lower, upper)(rng_);
  }
  double power_of_ten(double lower, double upper) { return std::pow(10.0, between(lower, upper)); }
  Vec3 direction()
  {
    std::normal_distribution<double> normal;
    const double x = normal(rng_), y = normal(rng_), z = normal(rng_);
    return Vec3(x, y, z).normalized();
  }
  Body body()
  {
    const double r0 = between(0.03, 0.45);
    return torus(1.0, r0, between(0.0, 1.0) < 0.4 ? r0 : between(0.03, 0.6));
  }

 private:
  std::mt19937_64 rng_;
};

Mat3 hessian(const FieldValue& f)
{
  return f.m.k * f.meridian * f.meridian.transpose() + f.k_azimuth * f.azimuth * f.azimuth.transpose();
}

TEST(FieldCurvature, BoundsSecondAndThirdDerivatives)
{
  Random random(1);
  int known = 0;
  double nearest_second = 0.0, nearest_third = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Body F = random.body();
    // Around a point of the surface, mostly outside.
    const double u = random.between(0.0, 6.3), v = random.between(0.0, 6.3);
    const Vec3 radial(std::cos(u), std::sin(u), 0.0);
    const Vec3 n = (F.r1 * std::cos(v) * radial + F.r0 * std::sin(v) * Vec3::UnitZ()).normalized();
    const Vec3 surface = (F.R + F.r0 * std::cos(v)) * radial + F.r1 * std::sin(v) * Vec3::UnitZ();
    const double height = (i % 4 == 0 ? -0.02 : 1.0) * random.power_of_ten(-4.0, 0.0) * std::min(F.r0, F.r1);
    const Vec3 x = surface + height * n;
    const double d = random.power_of_ten(-4.0, -0.5) * std::min(F.r0, F.r1);
    const FieldCurvature bound = field_curvature(F, field_at(F, x), d);
    if (!(bound.third < std::numeric_limits<double>::infinity())) continue;
    ++known;
    for (int k = 0; k < 20; ++k) {
      const Vec3 y = x + d * std::cbrt(random.between(0.0, 1.0)) * 0.999 * random.direction();
      const Vec3 w = random.direction();
      const FieldValue f = field_at(F, y);
      const double second = std::max(std::abs(f.m.k), std::abs(f.k_azimuth));
      EXPECT_LE(second, bound.second * (1.0 + 1e-9)) << i;
      const double h = 1e-5 * std::min(d, std::min(F.r0, F.r1));
      const double third =
          (w.dot(hessian(field_at(F, y + h * w)) * w) - w.dot(hessian(field_at(F, y - h * w)) * w)) /
          (2.0 * h);
      EXPECT_LE(std::abs(third), bound.third * (1.0 + 1e-4) + 1e-3 * bound.second) << i;
      nearest_second = std::max(nearest_second, second / bound.second);
      nearest_third = std::max(nearest_third, std::abs(third) / bound.third);
    }
  }
  EXPECT_GT(known, 10000);
  EXPECT_GT(nearest_second, 0.99);
  EXPECT_GT(nearest_third, 0.5) << "a bound that is never nearly reached is no good bound";
}

template <int dim>
double sampled_minimum(const Probe<dim>& probe, const Panel& s)
{
  constexpr int n = 24;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -n; i <= n; ++i)
    for (int j = dim == 2 ? -n : 0; j <= (dim == 2 ? n : 0); ++j)
      least = std::min(least, field_at(*probe.f.F, probe.at(s.u + s.hu * i / n, s.v + s.hv * j / n).p).m.phi);
  return least;
}

template <int dim>
void expect_below_samples(int count, std::uint64_t seed)
{
  Random random(seed);
  int better = 0, known = 0, oval = 0, wider = 0;
  for (int i = 0; i < count; ++i) {
    const Body F = random.body();
    Body P = random.body();
    while (P.is_circle_tube() != (dim == 1)) P = random.body();
    Pose pp, pf;
    // Linked, and close to touching as often as not.
    pp.position = Vec3(random.between(0.5, 2.2 - P.r0 - F.r0), 0.0, 0.0) + 0.2 * random.direction();
    pp.rotation = Eigen::AngleAxisd(random.between(0.0, 3.1), random.direction()).toRotationMatrix();
    const PairFrame frame(P, pp, F, pf);
    const Probe<dim> probe(frame);
    Panel s{random.between(0.0, 6.3), random.between(0.0, 6.3), random.power_of_ten(-5.0, -0.3), 0.0};
    if constexpr (dim == 2) s.hv = random.power_of_ten(-5.0, -0.3);
    const ProbePoint q = probe.at(s.u, s.v);
    const FieldValue f = field_at(F, q.p);
    const double gu = f.n.dot(q.pu), gv = dim == 2 ? f.n.dot(q.pv) : 0.0;
    const double least = sampled_minimum(probe, s);
    const double plain = taylor_bound(probe, s, f.m.phi, f.rho, gu, gv);
    EXPECT_LE(plain, least + 1e-15) << i;
    const FieldCurvature field = field_curvature(F, f, panel_size(probe, s).first);
    if (!(field.third < std::numeric_limits<double>::infinity())) continue;
    ++known;
    const double curved = curved_bound(probe, s, q, f, field);
    EXPECT_LE(curved, least + 1e-15) << i;
    better += curved > plain ? 1 : 0;
    const PanelBound best = panel_bound(probe, s, q, f, std::numeric_limits<double>::infinity());
    EXPECT_EQ(best.value, f.m.phi);
    EXPECT_EQ(best.bound, plain);  // the centre alone fails: nothing dearer is tried
    const PanelBound all = panel_bound(probe, s, q, f, f.m.phi);
    EXPECT_LE(all.bound, least + 1e-15) << i;
    EXPECT_GE(all.bound, plain);
    if (F.is_circle_tube()) continue;
    ++oval;
    const RolledField rolled(F, f);
    const FieldCurvature disc = rolled.curvature(panel_size(probe, s).first);
    if (!(disc.third < std::numeric_limits<double>::infinity())) continue;
    const double wide = curved_bound(probe, s, q, rolled.f, disc);
    EXPECT_LE(wide, least + 1e-15) << i;
    wider += wide > curved && wide > plain ? 1 : 0;
  }
  EXPECT_GT(known, count / 2);
  EXPECT_GT(better, known / 4);
  EXPECT_GT(wider, oval / 20);
}

TEST(PanelBound, CirclesStayAboveTheirBounds) { expect_below_samples<1>(20000, 2); }
TEST(PanelBound, SurfacesStayAboveTheirBounds) { expect_below_samples<2>(3000, 3); }

TEST(Strip, NothingOutsideOfItsWindowIsNearer)
{
  Random random(5);
  int windows = 0, none = 0, moving = 0;
  double narrowest = all_around, tightest = 0.0;
  constexpr int count = 4000, samples = 60;
  for (int i = 0; i < count; ++i) {
    const Body F = torus(1.0, random.between(0.05, 0.3), random.between(0.05, 0.3));
    const Body P = torus(1.0, random.between(0.05, 0.3), random.between(0.05, 0.3));
    Pose pp;
    pp.position = Vec3(random.between(0.5, 2.2 - P.r0 - F.r0), 0.0, 0.0) + 0.2 * random.direction();
    pp.rotation = Eigen::AngleAxisd(random.between(0.0, 3.1), random.direction()).toRotationMatrix();
    const PairFrame frame(P, pp, F, Pose{});
    ASSERT_TRUE(has_strips(frame));
    const Probe<2> probe(frame);
    Panel s{random.between(0.0, 6.3), 0.0, random.power_of_ten(-4.0, -0.5), all_around};
    s.v = facing_angle(frame, Angle(s.u)) + random.between(-0.2, 0.2);
    const ProbePoint q = probe.at(s.u, s.v);
    const FieldValue f = field_at(F, q.p);
    if (f.m.phi < 0.0) continue;
    StripMotion motion;
    if (i % 2 == 0) {
      const double size = random.power_of_ten(-4.0, -1.0);
      motion.velocity = size * random.direction();
      motion.turn = size * random.between(0.0, 1.0) * random.direction();
      motion.bend = 0.1 * size * random.between(0.0, 1.0);
      ++moving;
    }
    const double needed = f.m.phi + random.between(-0.5, 0.3) * random.power_of_ten(-3.0, -0.3);
    const StripWindow window = strip_window(probe, s, q, f, needed, motion);
    windows += window.half > 0.0 && window.half < all_around ? 1 : 0;
    none += window.half == 0.0 ? 1 : 0;
    if (window.half > 0.0) narrowest = std::min(narrowest, window.half);
    const double bound = StripBound(probe, s, q, f, motion).bound();
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < samples; ++k) {
      const double u = s.u + s.hu * random.between(-1.0, 1.0);
      // Around the border of the window as often as anywhere.
      double dv = random.between(-all_around, all_around);
      if (k % 2 == 0)
        dv = std::copysign(std::min(window.half + random.power_of_ten(-5.0, 0.0), all_around), dv);
      const Vec3 p = probe.at(u, s.v + dv).p;
      const double t = random.between(0.0, 1.0);
      const Vec3 there =
          p + t * (motion.velocity + motion.turn.cross(p - q.p)) + motion.bend * random.direction();
      const double phi = field_at(F, there).m.phi;
      least = std::min(least, phi);
      EXPECT_GE(phi, bound - 1e-14) << i;
      if (std::abs(dv) > window.half) {
        EXPECT_GE(phi, needed - 1e-14) << i;
      }
    }
    if (window.half == 0.0) {
      EXPECT_GE(window.bound, needed);
    }
    if (bound > 0.0) tightest = std::max(tightest, bound / least);
  }
  EXPECT_GT(windows, count / 10);
  EXPECT_GT(none, count / 10);
  EXPECT_GT(moving, count / 4);
  EXPECT_LT(narrowest, 0.02);
  EXPECT_GT(tightest, 0.99);
}

TEST(PanelBound, ErrorOfTheDearerBoundIsOfThirdOrder)
{
  // Parallel tubes, one ring on the other: the field along the core is nearly constant, H nearly nothing.
  const Body P = torus(1.0, 0.2, 0.2), F = torus(1.0, 0.2, 0.2);
  Pose pp;
  pp.position = Vec3(0.0, 0.0, 0.41);
  const PairFrame frame(P, pp, F, Pose{});
  const Probe<1> probe(frame);
  std::array<double, 3> loss{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Panel s{0.3, 0.0, 0.02 / static_cast<double>(1U << k), 0.0};
    const ProbePoint q = probe.at(s.u, s.v);
    const FieldValue f = field_at(F, q.p);
    loss[k] = f.m.phi - curved_bound(probe, s, q, f, field_curvature(F, f, panel_size(probe, s).first));
  }
  EXPECT_NEAR(loss[0] / loss[1], 8.0, 1.0);
  EXPECT_NEAR(loss[1] / loss[2], 8.0, 1.0);
}

TEST(LeastOverBox, AgreesWithSamples)
{
  Random random(4);
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    Quadratic q{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0),
                random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    const double hx = random.power_of_ten(-1.0, 0.0), hy = random.power_of_ten(-1.0, 0.0);
    // Half of them near a minimum, as panels are.
    if (i % 2 == 0) {
      q.uu = 1.0 + std::abs(q.uu);
      q.vv = 1.0 + std::abs(q.vv);
      q.u *= hx;
      q.v *= hy;
    }
    double least = 0.0;
    bool at_border = true;
    for (int a = -50; a <= 50; ++a)
      for (int b = -50; b <= 50; ++b) {
        const double x = hx * a / 50.0, y = hy * b / 50.0;
        const double value = q.u * x + q.v * y + 0.5 * (q.uu * x * x + 2.0 * q.uv * x * y + q.vv * y * y);
        if (value < least) at_border = std::abs(a) == 50 || std::abs(b) == 50;
        least = std::min(least, value);
      }
    inside += at_border ? 0 : 1;
    const double found = least_over_box(q, hx, hy);
    EXPECT_LE(found, least + 1e-15);
    EXPECT_NEAR(found, least, 1e-3);
  }
  EXPECT_GT(inside, 1000);
}

TEST(RolledField, IsNowhereAboveTheFieldAndEqualWhereItTouches)
{
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Body F = random.body();
    const Vec3 at = Vec3(random.between(0.0, 2.0), 0.0, random.between(-1.0, 1.0));
    const FieldValue f = field_at(F, at);
    if (f.m.phi <= 0.0) continue;
    const RolledField rolled(F, f);
    const double cx = f.rho - (rolled.radius + f.m.phi) * f.m.nr,
                 cz = at.z() - (rolled.radius + f.m.phi) * f.m.nz;
    EXPECT_NEAR(std::hypot(f.rho - cx, at.z() - cz) - rolled.radius, f.m.phi, 1e-13);
    for (int k = 0; k < 50; ++k) {
      const double x = at.x() + random.between(-1.0, 1.0), z = at.z() + random.between(-1.0, 1.0);
      const double phi = meridian_distance(F, x, z).phi;
      if (phi <= 0.0) continue;
      EXPECT_LE(std::hypot(x - cx, z - cz) - rolled.radius, phi + 1e-13);
    }
  }
}

TEST(PanelBound, APanelWithItsMinimumOffTheCentreLosesNoMoreThanTheThirdOrder)
{
  // Linked rings at a right angle: the core of P comes nearest to F's at u = pi.
  const Body P = torus(1.0, 0.2, 0.2), F = torus(1.0, 0.2, 0.2);
  Pose pp;
  pp.position = Vec3(1.59, 0.0, 0.0);
  pp.rotation = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  const PairFrame frame(P, pp, F, Pose{});
  const Probe<1> probe(frame);
  std::array<double, 3> loss{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = 0.02 / static_cast<double>(1U << k);
    const Panel s{std::numbers::pi + 0.9 * h, 0.0, h, 0.0};
    const ProbePoint q = probe.at(s.u, s.v);
    const FieldValue f = field_at(F, q.p);
    loss[k] = field_at(F, probe.at(std::numbers::pi, 0.0).p).m.phi -
              curved_bound(probe, s, q, f, field_curvature(F, f, panel_size(probe, s).first));
  }
  EXPECT_GT(loss[2], 0.0);
  EXPECT_NEAR(loss[0] / loss[1], 8.0, 1.0);
  EXPECT_NEAR(loss[1] / loss[2], 8.0, 1.0);
}

}  // namespace
}  // namespace hauberk::test
