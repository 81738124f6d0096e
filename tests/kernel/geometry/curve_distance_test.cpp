/// Distances, nearest points and links of tubes around curves, against circles and against brute force.

#include <scenes.hpp>
#include "contact/formulation.hpp"
#include "curve_pairs.hpp"
#include "geometry/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hauberk::test {
namespace {

using std::numbers::pi;

TEST(ClosedCurve, DerivativesAndBounds)
{
  std::mt19937_64 rng(3);
  for (int trial = 0; trial < 20; ++trial) {
    const ClosedCurve curve(wavy(0.3, 0.05, rng).curve, 2.0);
    std::array<double, 3> largest{};
    const double h = 1e-4;
    for (int i = 0; i < 997; ++i) {
      const double u = 2.0 * pi * i / 997;
      const CurvePoint p = curve.at(Angle(u)), a = curve.at(Angle(u - h)), b = curve.at(Angle(u + h));
      EXPECT_LT(((b.x - a.x) / (2.0 * h) - p.xu).norm(), 1e-7);
      EXPECT_LT(((b.xu - a.xu) / (2.0 * h) - p.xuu).norm(), 1e-6);
      const double third = (b.xuu - a.xuu).norm() / (2.0 * h);
      EXPECT_LE(third, curve.third() * (1.0 + 1e-6));
      largest = {std::max(largest[0], p.x.norm()), std::max(largest[1], p.xu.norm()),
                 std::max(largest[2], p.xuu.norm())};
    }
    const std::array<double, 3> bounds{curve.radius(), curve.first(), curve.second()};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(largest[k], bounds[k]);
      EXPECT_GT(largest[k], 0.95 * bounds[k]);
    }
  }
  EXPECT_NEAR(ClosedCurve(circle_curve(1.5, 0.1).curve, 1.0).tightest_bend(), 1.5, 1e-12);
  EXPECT_NEAR(mean_radius(circle_curve(1.5, 0.1).curve), 1.5, 1e-15);
  // Of an ellipse, at the ends of its long axis: b^2/a.
  EXPECT_NEAR(ClosedCurve({{Vec3(2, 0, 0), Vec3(0, 1, 0)}}, 1.0).tightest_bend(), 0.5, 1e-12);
}

template <int dim>
std::vector<double> minima(const PairFrame& frame, double threshold)
{
  int evaluations = 0;
  std::vector<double> out;
  for (const Minimum& m : local_minima<dim>(frame, threshold, evaluations)) out.push_back(m.distance);
  return out;
}

TEST(CurveTubes, CirclesAsCurvesHaveTheSameDistancesMinimaAndLinks)
{
  std::mt19937_64 rng(11);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  int linked = 0, several = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double R = 0.8 + 0.4 * even(rng), r = 0.1 + 0.1 * even(rng);
    const Pose pose = linked_pose(2.2 * even(rng), 1.5, rng);
    const Couple plain(circle(1.0, 0.15), circle(R, r), pose);
    const Couple one(circle_curve(1.0, 0.15), circle(R, r), pose);
    const Couple both(circle_curve(1.0, 0.15), circle_curve(R, r), pose);
    ASSERT_EQ(probe_dimension(one.frame()), 1);
    ASSERT_EQ(probe_dimension(both.frame()), 2);
    const auto bounds = [](const Couple& c) {
      return separation(c.A, c.pose, c.B, Pose{}, 0.0, 1e300, 0.999);
    };
    const Separation a = bounds(plain), b = bounds(one), c = bounds(both);
    if (a.lower > 0.0) {
      for (const Separation& s : {b, c}) {
        EXPECT_LE(s.lower, a.upper * (1.0 + 1e-12));
        EXPECT_GE(s.upper, a.lower * (1.0 - 1e-12));
        EXPECT_GE(s.lower, 0.998 * s.upper);
      }
    } else {
      EXPECT_LE(b.lower, 0.0);
      EXPECT_LE(c.lower, 0.0);
    }
    const std::vector<double> x = minima<1>(plain.frame(), 0.4), y = minima<1>(one.frame(), 0.4),
                              z = minima<2>(both.frame(), 0.4);
    ASSERT_EQ(x.size(), y.size()) << trial;
    ASSERT_EQ(x.size(), z.size()) << trial;
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_NEAR(x[k], y[k], 1e-13);
      EXPECT_NEAR(x[k], z[k], 1e-13);
    }
    several += x.size() > 1;
    if (!(a.lower > 0.01)) continue;
    const int number = linking_number(plain.A, pose, plain.B, Pose{});
    EXPECT_EQ(linking_number(one.A, pose, one.B, Pose{}), number);
    EXPECT_EQ(linking_number(both.A, pose, both.B, Pose{}), number);
    linked += number != 0;
  }
  EXPECT_GT(linked, 30);
  EXPECT_GT(several, 30);
}

TEST(CurveTubes, AKnotIsLinkedAsOftenAsItGoesAround)
{
  // A ring through the hole of a knot that turns p times around the z axis.
  for (const auto& [p, q] : {std::pair{2, 3}, std::pair{3, 2}, std::pair{2, 5}}) {
    Pose upright{Vec3(1.9, 0, 0), rotation_exp(Vec3(0.5 * pi, 0, 0))};
    const Couple c(circle(1.9, 0.05), knot(p, q, 0.05), upright);
    EXPECT_EQ(std::abs(linking_number(c.A, c.pose, c.B, Pose{})), p);
    const Couple turned(circle_curve(1.9, 0.05), knot(p, q, 0.05), upright);
    EXPECT_EQ(linking_number(turned.A, turned.pose, turned.B, Pose{}),
              linking_number(c.A, c.pose, c.B, Pose{}));
  }
}

TEST(CurveTubes, MinimaDoNotDependOnWhichIsProbed)
{
  // A thin rounded polygon, whose corners are wells, beside a thick ring.
  std::vector<Harmonic> corners(6);
  corners[0] = {Vec3(0.25, 0, 0), Vec3(0, 0.25, 0)};
  corners[5] = {Vec3(0.012, 0, 0), Vec3(0, -0.012, 0)};
  std::mt19937_64 rng(23);
  std::size_t most = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Primitive ring = wavy(0.05, 0.2, rng), polygon = curve_tube(corners, 0.004);
    const Pose pose = linked_pose(1.0, 1.5, rng);
    const Couple one(ring, polygon, pose);
    const PairFrame back(one.B, Pose{}, one.A, pose);
    const std::vector<double> x = minima<2>(one.frame(), 1.0), y = minima<2>(back, 1.0);
    ASSERT_EQ(x.size(), y.size()) << trial;
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-12);
    most = std::max(most, x.size());
  }
  EXPECT_GT(most, 4U);
}

/// Field over the probe set at `count` x `count` coordinates, less the offset.
std::vector<double> grid(const PairFrame& frame, int count)
{
  const Probe<2> probe(frame);
  std::vector<double> out;
  out.reserve(count * count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const ProbePoint q = probe.at(2.0 * pi * i / count, 2.0 * pi * j / count);
      out.push_back(field_at(*frame.F, q.p).m.phi - probe.offset);
    }
  }
  return out;
}

TEST(CurveTubes, NothingIsNearerThanTheBoundAndNoMinimumIsMissed)
{
  std::mt19937_64 rng(17);
  constexpr int count = 360;
  constexpr double threshold = 0.8;
  int found = 0;
  for (int trial = 0; trial < 36; ++trial) {
    const Primitive first = trial % 3 == 0 ? knot(2, 3, 0.06) : wavy(0.25, 0.08, rng);
    const Couple c(first, wavy(0.25, 0.08, rng), linked_pose(1.5, 1.0, rng));
    const PairFrame frame = c.frame();
    const std::vector<double> f = grid(frame, count);
    const double least = *std::min_element(f.begin(), f.end());
    const Separation s = separation(c.A, c.pose, c.B, Pose{}, 0.0, 1e300, 0.999);
    EXPECT_LE(s.lower, std::max(least, 0.0));
    const Probe<2> probe(frame);
    const double width = pi / count;
    // A minimum between points of the grid is lower by the second derivatives over half a cell at most.
    const double curved = probe.Luu + probe.Lvv + 4.0 * (probe.Lu + probe.Lv) * (probe.Lu + probe.Lv) / 0.14;
    if (least > 0.0) {
      EXPECT_GE(s.lower, 0.998 * (least - curved * width * width)) << trial;
    }
    if (least < 0.01) continue;
    int evaluations = 0;
    const std::vector<Minimum> known = local_minima<2>(frame, threshold, evaluations);
    for (const Minimum& m : known) {
      const ProbePoint q = probe.at(m.u, m.v);
      const FieldValue v = field_at(*frame.F, q.p);
      EXPECT_LT(std::abs(v.n.dot(q.pu)) + std::abs(v.n.dot(q.pv)), 1e-9);
      EXPECT_GE(m.distance, s.lower);
    }
    const auto at = [&f](int i, int j) { return f[(i + count) % count * count + (j + count) % count]; };
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        if (at(i, j) > threshold - 0.01) continue;
        bool lowest = true;
        for (int di = -2; di <= 2; ++di)
          for (int dj = -2; dj <= 2; ++dj) lowest = lowest && at(i, j) <= at(i + di, j + dj);
        if (!lowest) continue;
        const bool listed = std::any_of(known.begin(), known.end(), [&](const Minimum& m) {
          const auto near = [](double x, double y) {
            return std::abs(std::remainder(x - y, 2.0 * pi)) < 0.06;
          };
          return near(m.u, 2.0 * pi * i / count) && near(m.v, 2.0 * pi * j / count);
        });
        EXPECT_TRUE(listed) << trial << ": " << i << " " << j << " " << at(i, j);
        ++found;
      }
    }
  }
  EXPECT_GT(found, 30);
}

}  // namespace
}  // namespace hauberk::test
