/// The published contact on one pair: closed-form energy, derivatives in all relative pose unknowns and all
/// sizes, with active fade, at a double eigenvalue and on the way to a merge of minima.

#include "contact/published.hpp"
#include "contact/formulation.hpp"
#include "differences.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

/// P moves, F stays at the origin; P's centre is off its element's origin.
struct Pair {
  Body P, F;
  Pose pose;

  PairFrame frame() const { return PairFrame(P, pose, F, Pose{}); }
  Pair moved(const Vec6& y, double h) const
  {
    Pair n = *this;
    n.pose.position += h * y.head<3>();
    n.pose.rotation = rotation_exp(h * y.tail<3>()) * n.pose.rotation;
    return n;
  }
};

Body torus(double R, double r0, double r1)
{
  Body b;
  b.kind = r0 == r1 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
  b.R = R;
  b.r0 = r0;
  b.r1 = r1;
  return b;
}

/// P threads F at F's inner equator, its plane perpendicular to F's and its own inner equator towards F's, so
/// that the surfaces are `gap` apart; then turned by `tilt` about its element's origin.
Pair linked(const Body& P, const Body& F, double gap, const Vec3& tilt)
{
  Pair p{P, F, {}};
  p.P.center = Vec3(0.13, -0.21, 0.17);
  Mat3 axes;  // P's axis along y: its ring is in the xz-plane, F's in the xy-plane
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  p.P.axes = axes;
  // F's inner equator at x = FR - f0; P's at its own x = -(R - r0) from its centre, beyond by the gap.
  p.pose.position = Vec3(F.R - F.r0 - gap + P.R - P.r0, 0, 0) - p.P.center;
  p.pose.rotation = rotation_exp(tilt);
  return p;
}

SideTerms terms(const Pair& p, double g_hat, double clearance, const Request& request)
{
  SideTerms t;
  const ContactSettings settings{Formulation::published, g_hat, clearance};
  if (p.P.is_circle_tube()) {
    add_published<1>(p.frame(), settings, request, t);
  } else {
    add_published<2>(p.frame(), settings, request, t);
  }
  return t;
}

/// Gradient against energies, Hessian against gradients along exp(h w), in the six unknowns and in sums of
/// two of them (so every entry of the Hessian counts).
void check_pose(const Pair& p, double g_hat, double clearance, double step)
{
  const SideTerms t = terms(p, g_hat, clearance, {2, false, false});
  ASSERT_GT(t.energy, 0.0);
  ASSERT_GT(t.gradient.norm(), 0.0);
  EXPECT_LT((t.hessian - t.hessian.transpose()).norm(), 1e-14 * t.hessian.norm());
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      Vec6 y = Vec6::Unit(i);
      if (j < i) y += Vec6::Unit(j);
      std::array<double, 3> eg{}, eh{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double h = step / (1 << k);
        const SideTerms a = terms(p.moved(y, h), g_hat, clearance, {1, false, false});
        const SideTerms b = terms(p.moved(y, -h), g_hat, clearance, {1, false, false});
        eg[k] = std::abs((a.energy - b.energy) / (2 * h) - t.gradient.dot(y));
        eh[k] = std::abs((a.gradient - b.gradient).dot(y) / (2 * h) - y.dot(t.hessian * y));
      }
      expect_second_order(eg, t.gradient.norm(), 1e-7, "gradient");
      expect_second_order(eh, t.hessian.norm(), 1e-7, "Hessian");
    }
  }
}

/// Derivatives in P's and F's centre and sizes and in the clearance.
void check_sizes(const Pair& p, double g_hat, double clearance, double step)
{
  const SideTerms t = terms(p, g_hat, clearance, {1, true, false});
  const auto compare = [&](double expected, auto&& change, bool counts) {
    std::array<double, 3> error{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double h = step / (1 << k);
      Pair a = p, b = p;
      double ca = clearance, cb = clearance;
      change(a, ca, h);
      change(b, cb, -h);
      error[k] =
          std::abs((terms(a, g_hat, ca, {}).energy - terms(b, g_hat, cb, {}).energy) / (2 * h) - expected);
    }
    if (counts) {
      EXPECT_NE(expected, 0.0);
    }
    expect_second_order(error, t.gradient.norm(), 1e-7, "sizes");
  };
  for (const bool of_p : {true, false}) {
    const auto body = [of_p](Pair& q) -> Body& { return of_p ? q.P : q.F; };
    const auto& d = of_p ? t.dP : t.dF;
    // The centre is in the element frame; dP and dF in F's, which is the world here.
    const Mat3 Q = of_p ? p.pose.rotation : Mat3::Identity();
    const Vec3 local = Q.transpose() * Vec3(d[0], d[1], d[2]);
    for (int k = 0; k < 3; ++k) {
      compare(
          local[k], [&](Pair& q, double&, double h) { body(q).center[k] += h; }, false);
    }
    compare(
        d[3], [&](Pair& q, double&, double h) { body(q).R += h; }, true);
    const auto ellipse = [&](Pair& q, double h0, double h1) {
      body(q).r0 += h0;
      body(q).r1 += h1;
      body(q).kind = PrimitiveKind::revolved_ellipse;
    };
    compare(
        d[4], [&](Pair& q, double&, double h) { ellipse(q, h, 0); }, true);
    compare(
        d[5], [&](Pair& q, double&, double h) { ellipse(q, 0, h); }, false);
  }
  compare(
      t.d_clearance, [](Pair&, double& c, double h) { c += h; }, true);
}

/// Where a contact is on the plots of equations (9) and (10).
struct Place {
  double y;  ///< smallest eigenvalue over lambda_bar
  double x;  ///< squared gap over d_hat
};

std::vector<Place> places(const Pair& p, double g_hat)
{
  std::vector<Place> out;
  int evaluations = 0;
  const TorusPair<double> charts = torus_pair(p.frame());
  for (const Minimum& m : local_minima<2>(p.frame(), g_hat, evaluations)) {
    const ProbePoint q = Probe<2>(p.frame()).at(m.u, m.v);
    const FieldValue f = field_at(p.F, q.p);
    const auto c = published::refine(
        charts, {m.u, m.v, std::atan2(q.p.y(), q.p.x()), std::atan2(f.m.s, f.m.c)}, evaluations);
    out.push_back({c.eigenvalues[0] / (published::lambda_bar * g_hat * g_hat), c.d / (g_hat * g_hat)});
  }
  return out;
}

bool any(const std::vector<Place>& list, double least_x, double most_x)
{
  for (const Place& p : list) {
    if (p.y > 0.05 && p.y < 0.95 && p.x > least_x && p.x < most_x) return true;
  }
  return false;
}

/// Two perpendicular rings at their inner equators: with W = R - r the Hessian of d falls into two blocks
///   2 [[W (W - g), +-W f], [+-W f, f (f + g)]],   (ring angle of one, tube angle f of the other).
double block_eigenvalue(double W, double f, double g)
{
  const double a = W * (W - g), c = f * (f + g), b = W * f;
  return a + c - std::hypot(a - c, 2.0 * b);
}

TEST(Published, EnergyOfPerpendicularRings)
{
  const double R = 1.0, r = 0.15, f = 0.2, g_hat = 0.4;
  for (const double gap : {0.005, 0.006, 0.02, 0.1, 0.3}) {
    const Pair p = linked(torus(R, r, r), torus(R, f, f), gap, Vec3::Zero());
    const double first = block_eigenvalue(R - r, f, gap), second = block_eigenvalue(R - f, r, gap);
    const double d_hat = g_hat * g_hat, width = 0.01 * 0.1 * d_hat;
    const double lambda =
        0.5 * (first + second) - std::sqrt(0.25 * (first - second) * (first - second) + width * width);
    const double y = std::min(1.0, lambda / (0.1 * d_hat)), x = gap * gap / d_hat;
    const double h = y > 0.0 ? -4.0 * std::pow(y, 5) + 5.0 * std::pow(y, 4) : 0.0;
    const double t = std::clamp((x - 1e-4) / 3e-4, 0.0, 1.0);
    const double s = h * t * t * (3.0 - 2.0 * t) + (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t);
    const double expected = s * -(1.0 - x) * (1.0 - x) * std::log(x);
    ASSERT_GT(expected, 0.0);
    EXPECT_NEAR(terms(p, g_hat, 0.0, {}).energy, expected, 1e-9 * expected) << gap;
  }
}

TEST(Published, DerivativesWhileFaded)
{
  std::mt19937_64 rng(3);
  std::normal_distribution<double> normal;
  const std::vector<std::pair<Body, Body>> kinds{{torus(1.0, 0.15, 0.15), torus(0.95, 0.17, 0.17)},
                                                 {torus(1.0, 0.15, 0.15), torus(0.95, 0.15, 0.2)},
                                                 {torus(1.0, 0.14, 0.2), torus(0.95, 0.15, 0.19)}};
  for (const auto& [P, F] : kinds) {
    int wide = 0, close = 0;
    for (int trial = 0; trial < 8; ++trial) {
      const bool tiny = trial % 2 == 1;
      const Vec3 tilt = (tiny ? 0.01 : 0.05) * Vec3(normal(rng), normal(rng), normal(rng));
      const double g_hat = tiny ? 0.12 : 0.5, gap = tiny ? 0.0017 : 0.06;
      Pair p = linked(P, F, gap, Vec3::Zero());
      // Tilting about the contact keeps the gap's size.
      const Vec3 contact(F.R - F.r0, 0, 0);
      const Mat3 T = rotation_exp(tilt);
      p.pose.rotation = T;
      p.pose.position = contact + T * (p.pose.position - contact);
      SCOPED_TRACE(trial);
      const auto where = places(p, g_hat);
      wide += any(where, published::d2 * 1.05, 0.95) ? 1 : 0;
      close += any(where, published::d1 * 1.05, published::d2 * 0.95) ? 1 : 0;
      const double step = tiny ? 1e-5 : 1e-4;
      check_pose(p, g_hat, 0.0, step);
      check_sizes(p, g_hat, 0.0, step);
      // With a clearance, the same squared gap.
      Pair apart = p;
      apart.pose.position.x() -= 0.01;
      check_pose(apart, g_hat, 0.01, step);
      check_sizes(apart, g_hat, 0.01, step);
    }
    EXPECT_GE(wide, 3);
    EXPECT_GE(close, 3);
  }
}

/// Two equal perpendicular rings: by symmetry the two smallest eigenvalues are one.
TEST(Published, DerivativesAtADoubleEigenvalue)
{
  for (const bool ellipse : {false, true}) {
    const Body ring = ellipse ? torus(1.0, 0.15, 0.17) : torus(1.0, 0.15, 0.15);
    for (const bool tiny : {false, true}) {
      const double g_hat = tiny ? 0.12 : 0.5;
      const Pair p = linked(ring, ring, tiny ? 0.0017 : 0.06, Vec3::Zero());
      int evaluations = 0;
      const auto m = published::refine(
          torus_pair(p.frame()), {std::numbers::pi, std::numbers::pi, 0.0, std::numbers::pi}, evaluations);
      ASSERT_TRUE(m.converged);
      ASSERT_NEAR(m.eigenvalues[0], m.eigenvalues[1], 1e-12);
      ASSERT_LT(m.eigenvalues[0], 0.9 * published::lambda_bar * g_hat * g_hat);
      check_pose(p, g_hat, 0.0, tiny ? 1e-5 : 4e-5);
      check_sizes(p, g_hat, 0.0, tiny ? 1e-5 : 4e-5);
    }
  }
}

/// A flat section that rolls on a ring of smaller hole: two contacts become one. The plain sum of barriers
/// jumps there; the faded one is the integral of its own derivative.
TEST(Published, EnergyIsContinuousWhereAContactVanishes)
{
  const Body P = torus(1.0, 0.1, 0.3), F = torus(0.9, 0.15, 0.15);
  const double g_hat = 0.5;
  const Vec3 contact(F.R - F.r0, 0, 0);
  const auto at = [&](double angle) {
    Pair p = linked(P, F, 0.06, Vec3::Zero());
    p.pose.rotation = rotation_exp(Vec3(0, 0, angle));
    p.pose.position = contact + p.pose.rotation * (p.pose.position - contact);
    return p;
  };
  double before = 0.0, slope_before = 0.0, plain_before = 0.0, defect = 0.0, jump = 0.0, steepest = 0.0;
  std::size_t count_before = 0;
  constexpr int steps = 400;
  constexpr double h = 0.02 / steps;
  for (int k = 0; k <= steps; ++k) {
    const Pair p = at(0.015 + k * h);
    const SideTerms t = terms(p, g_hat, 0.0, {1, false, false});
    Vec6 y;
    y << Vec3::UnitZ().cross(p.pose.position - contact), Vec3::UnitZ();
    const double slope = t.gradient.dot(y);
    const auto where = places(p, g_hat);
    double plain = 0.0;
    for (const Place& q : where) plain += published::barrier(q.x);
    if (k > 0) {
      defect = std::max(defect, std::abs(t.energy - before - 0.5 * h * (slope + slope_before)));
      if (where.size() < count_before) jump = plain_before - plain;
    }
    before = t.energy;
    slope_before = slope;
    plain_before = plain;
    count_before = where.size();
    steepest = std::max(steepest, std::abs(slope));
  }
  EXPECT_GT(jump, 3.0);
  EXPECT_GT(steepest, 1.0);
  EXPECT_LT(defect, 1e-7);
  check_pose(at(0.02), g_hat, 0.0, 4e-5);
  check_pose(at(0.023), g_hat, 0.0, 2e-5);
}

/// The pair has no probe and no field: both ways to find the minima, and both labels, give one energy.
TEST(Published, DoesNotDependOnLabels)
{
  const Body A = torus(1.0, 0.15, 0.15), B = torus(0.9, 0.2, 0.2);
  const Pair p = linked(A, B, 0.07, Vec3(0.03, -0.05, 0.04));
  const ContactSettings settings{Formulation::published, 0.4, 0.0};
  SideTerms line, surface, swapped;
  add_published<1>(p.frame(), settings, {2, true, true}, line);
  add_published<2>(p.frame(), settings, {2, true, true}, surface);
  add_published<1>(PairFrame(p.F, Pose{}, p.P, p.pose), settings, {2, true, true}, swapped);
  ASSERT_GT(line.energy, 0.0);
  EXPECT_NEAR(surface.energy, line.energy, 1e-12 * line.energy);
  EXPECT_NEAR(swapped.energy, line.energy, 1e-12 * line.energy);
  EXPECT_LT((surface.gradient - line.gradient).norm(), 1e-10 * line.gradient.norm());
  EXPECT_LT((surface.hessian - line.hessian).norm(), 1e-8 * line.hessian.norm());
  for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(swapped.dF[k], line.dP[k], 1e-10 * line.gradient.norm());
  ASSERT_EQ(line.points.size(), swapped.points.size());
  EXPECT_NEAR(line.points[0].force, swapped.points[0].force, 1e-10 * line.points[0].force);
}

}  // namespace
}  // namespace hauberk::test
