/// Rings of rounded wire: their distance against samples of their chart, their curvature, and what is
/// refused.

#include "../rounded_ring.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hauberk {
namespace {

using Sizes = std::array<double, 4>;

/// Upright and flat wire, square wire, sharp corners, and a torus.
const std::array<Sizes, 5> all{{{5.0, 0.7, 0.7, 0.3},
                                {5.0, 0.5, 0.9, 0.1},
                                {5.0, 0.9, 0.4, 0.2},
                                {2.0, 0.5, 0.5, 0.01},
                                {5.0, 0.7, 0.7, 0.7}}};

TEST(RoundedRing, IsADistanceFromItsChart)
{
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Sizes& q : all) {
    // The section by many points; distances are those in the half-plane through the axis.
    constexpr int n = 40000;
    std::vector<Vec3> section;
    double longest = 0.0;
    for (int k = 0; k < n; ++k) {
      section.push_back(
          kit::chart_point<RoundedRing>(kit::turn(0.0), kit::turn(2.0 * std::numbers::pi * k / n), q.data()));
      if (k > 0) longest = std::max(longest, (section[k] - section[k - 1]).norm());
      EXPECT_NEAR(RoundedRing::field<double>({section[k].x(), 0.0, section[k].z()}, q.data()), 0.0,
                  1e-14 * q[0]);
    }
    EXPECT_LT(longest, 20.0 * (q[1] + q[2]) / n) << "the chart leaves a gap";
    for (int trial = 0; trial < 40; ++trial) {
      const double across = 2.0 * q[1] * uniform(rng), up = 2.0 * q[2] * uniform(rng), u = 3.0 * uniform(rng);
      const double rho = q[0] + across;
      double nearest = 1e9;
      for (const Vec3& x : section) nearest = std::min(nearest, std::hypot(x.x() - rho, x.z() - up));
      const double f = RoundedRing::field<double>({rho * std::cos(u), rho * std::sin(u), up}, q.data());
      EXPECT_NEAR(std::abs(f), nearest, longest) << rho << " " << up;
      // Half a step along a corner of radius c adds to the square of a distance d (1 + d/c) times its square.
      EXPECT_NEAR(f * f, nearest * nearest, longest * longest * (1.0 + std::abs(f) / q[3]))
          << rho << " " << up;
    }
  }
}

TEST(RoundedRing, HasItsBreaksWhereTheSecondDerivativeOfItsChartJumps)
{
  for (const Sizes& q : all) {
    const std::vector<double> breaks = RoundedRing::breaks(q.data());
    ASSERT_EQ(breaks.size(), 12U);
    const kit::ImplicitSolid<RoundedRing> ring({q.begin(), q.end()});
    const auto at = [&](double v) { return ring.probe({1.0, 0.0, std::cos(v), std::sin(v)}); };
    if (q[3] < std::min(q[1], q[2]))
      for (const double v : breaks) {
        // The first does not jump.
        EXPECT_LT((at(v + 1e-9).v - at(v - 1e-9).v).norm(), 1e-5 * q[1]) << v;
        EXPECT_GT((at(v + 1e-6).vv - at(v - 1e-6).vv).norm(), 0.1 * q[1]) << v;
      }
    for (int k = 0; k < 1000; ++k) {
      const double v = 2.0 * std::numbers::pi * k / 1000.0, h = 1e-6;
      const bool near = std::any_of(breaks.begin(), breaks.end(), [&](double b) {
        return std::abs(std::remainder(b - v, 2.0 * std::numbers::pi)) < 2.0 * h;
      });
      const ProbeBounds b = ring.probe_bounds(0.0, v, h, h);
      if (near) continue;
      EXPECT_LE((at(v + h).vv - at(v - h).vv).norm(), 2.0 * h * b.vvv + 1e-9 * q[0]) << v;
    }
  }
}

TEST(RoundedRing, RefusesWhatIsNoRing)
{
  const kit::SolidShape<RoundedRing> shape("ring");
  EXPECT_NO_THROW(shape.primitives(std::vector<double>{5.0, 0.7, 0.7, 0.7}));
  const auto message = [&](std::vector<double> p) -> std::string {
    try {
      shape.primitives(p);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({1.0, 1.0, 0.5, 0.1}), "w = 1 leaves no hole in a ring of R = 1");
  EXPECT_EQ(message({5.0, 0.7, 0.5, 0.6}), "corner = 0.6 is larger than half the wire, w = 0.7 and h = 0.5");
  EXPECT_EQ(message({1.0, 0.5, 0.5, 1e-7}),
            "corner = 1e-07 is below 1e-06 of the ring's size 1: too fine to be computed");
  // What is at the border is still certified.
  EXPECT_EQ(message({1.0, 0.5, 0.5, 1e-6}), "accepted");
  EXPECT_EQ(message({1.0, 1e-6, 1e-6, 1e-6}), "accepted");
  EXPECT_EQ(message({1.0, 0.5, 10.0, 1e-5}), "accepted");
}

}  // namespace
}  // namespace hauberk
