#include "pictures/angular_curve.hpp"
#include "pictures/polar_panel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace hauberk::detail {
namespace {

AngularValues random_values(std::uint64_t seed, std::size_t count)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(0.0, 1.0), step(0.2, 1.8);
  AngularValues out;
  double degrees = 10.0 * value(random);
  for (std::size_t k = 0; k < count; ++k) {
    out.emplace_back(degrees, value(random));
    degrees += step(random) * 180.0 / static_cast<double>(count);
  }
  return out;
}

/// The curve has every value, and lies between its neighbours everywhere else.
void expect_between(const AngularValues& values, const AngularValues& curve, bool closed)
{
  AngularValues ends = values;
  if (closed) ends.emplace_back(values.front().first + 360.0, values.front().second);
  std::size_t k = 0;
  for (const auto& [degrees, value] : curve) {
    if (k + 1 < ends.size() && degrees >= ends[k + 1].first) {
      ++k;
      EXPECT_EQ(degrees, ends[k].first);
      EXPECT_EQ(value, ends[k].second);
    }
    const std::size_t next = std::min(k + 1, ends.size() - 1);
    const auto [low, high] = std::minmax(ends[k].second, ends[next].second);
    EXPECT_GE(value, low - 1e-14) << degrees;
    EXPECT_LE(value, high + 1e-14) << degrees;
  }
  EXPECT_EQ(k + 1, ends.size());
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double step = curve[i].first - curve[i - 1].first;
    EXPECT_TRUE(step <= 2.0 + 1e-9 || step > 15.0) << step;
  }
}

TEST(AngularCurve, GoesThroughTheValuesAndNotBeyondThem)
{
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const AngularValues values = random_values(seed, 2 + seed % 30);
    for (const bool closed : {false, true}) expect_between(values, angular_curve(values, closed), closed);
  }
}

/// No corner where the last value meets the first: the curve does not depend on which value comes first.
TEST(AngularCurve, AClosedCurveHasNoBeginning)
{
  const AngularValues values = random_values(1, 12);
  AngularValues turned(values.begin() + 5, values.end());
  for (std::size_t k = 0; k < 5; ++k) turned.emplace_back(values[k].first + 360.0, values[k].second);
  AngularValues a = angular_curve(values, true), b = angular_curve(turned, true);
  for (AngularValues* curve : {&a, &b}) {
    curve->pop_back();
    for (auto& [degrees, value] : *curve) degrees = std::fmod(degrees, 360.0);
    std::sort(curve->begin(), curve->end());
  }
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(a[k].first, b[k].first, 1e-9);
    EXPECT_NEAR(a[k].second, b[k].second, 1e-12);
  }
}

/// A smooth profile from 24 directions: the curve is eight times as near to it as straight lines are.
TEST(AngularCurve, ASmoothProfileIsDrawnSmoothly)
{
  constexpr double step = 15.0, radian = std::numbers::pi / 180.0;
  const auto profile = [](double degrees) { return 1.0 + 0.2 * std::cos(2.0 * degrees * radian); };
  AngularValues values;
  for (int k = 0; k < 24; ++k) values.emplace_back(step * k, profile(step * k));
  double curve_off = 0.0, lines_off = 0.0;
  for (const auto& [degrees, value] : angular_curve(values, true)) {
    curve_off = std::max(curve_off, std::abs(value - profile(degrees)));
    const double from = step * std::floor(degrees / step), to = from + step;
    const double a = profile(from), b = profile(to);
    const double line = a * b * std::sin((to - from) * radian) /
                        (a * std::sin((degrees - from) * radian) + b * std::sin((to - degrees) * radian));
    lines_off = std::max(lines_off, std::abs(line - profile(degrees)));
  }
  EXPECT_LT(8.0 * curve_off, lines_off);
}

TEST(AngularCurve, WhatIsAboveTheLargestIsCutThere)
{
  const AngularValues curve{{0, 1}, {10, 3}, {20, 1}, {30, 2}, {40, 5}};
  const std::vector<AngularValues> parts = within(curve, 2.0);
  const std::vector<AngularValues> expected{{{0, 1}, {5, 2}}, {{15, 2}, {20, 1}, {30, 2}, {30, 2}}};
  EXPECT_EQ(parts, expected);
  EXPECT_TRUE(within(curve, 0.5).empty());
  EXPECT_EQ(within(curve, 5.0), std::vector<AngularValues>(1, curve));
}

Curve curve_of(std::vector<double> values, bool behind)
{
  Curve out;
  for (std::size_t k = 0; k < values.size(); ++k)
    out.points.emplace_back(10.0 * static_cast<double>(k), values[k]);
  out.behind = behind;
  return out;
}

TEST(PolarScale, HasRoomForWhatMatters)
{
  EXPECT_EQ(scale_of({}), 0.0);
  EXPECT_EQ(scale_of({curve_of({0.02, 0.03, 0.08}, false)}), 0.08);
  EXPECT_EQ(scale_of({curve_of({0.1, 0.1, 60.0}, false)}), 1.0) << "one pole among many values";
  EXPECT_EQ(scale_of({curve_of({0.1, 0.2}, false), curve_of({0.4, 0.1}, true)}), 0.4);
  EXPECT_EQ(scale_of({curve_of({0.1, 0.2}, false), curve_of({0.6, 0.1}, true)}), 0.2);
  EXPECT_EQ(scale_of({curve_of({0.6, 0.1}, true)}), 0.6) << "nothing else is there";
  EXPECT_EQ(scale_of({curve_of({0.05, 0.05, 0.05}, false), curve_of({0.8, 0.8}, false)}), 0.8)
      << "each curve by itself";
  Curve marks = curve_of({2.0}, false);
  marks.joined = false;
  EXPECT_EQ(scale_of({curve_of({0.1, 0.1, 0.1}, false), marks}), 2.0);
  Curve bars = curve_of({0.1}, false);
  bars.bars = {{0.0, 0.1, 0.3}};
  EXPECT_EQ(scale_of({bars}), 0.3);
}

}  // namespace
}  // namespace hauberk::detail
