// Bounds over single panels, which no search has tightened: against samples, and against derivatives to fifty
// digits.

#include "geometry/panel_bound.hpp"

#include "drawn_pairs.hpp"
#include "pair_field.hpp"
#include "panel_figures.hpp"
#include "random_pairs.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace hauberk::brute {
namespace {

using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

TEST(PanelBound, IsBelowEverySampleOfItsPanel)
{
  std::array<PanelFigures, 2> figures;
  std::mt19937_64 rng(20262);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (long k = 0; k < 6000; ++k) {
    const auto kind = static_cast<PairKind>(k % 3);
    DrawnPair p = drawn_pair(kind, k / 3);
    if (p.distance <= 0.0) continue;
    if (kind == PairKind::round_elliptical && !p.a.round()) std::swap(p.a, p.b);
    const double hu = std::pow(10.0, -3.0 + 2.7 * uniform(rng)),
                 hv = std::pow(10.0, -3.0 + 2.8 * uniform(rng));
    const Panel s{2.0 * std::numbers::pi * uniform(rng), 2.0 * std::numbers::pi * uniform(rng), hu,
                  p.a.round() ? 0.0 : hv};
    const std::string what = fmt::format("{} {} ({})", name(kind), k / 3, name(p.family));
    if (p.a.round()) {
      check_panel<1>(p, kernel_body(p.a), kernel_body(p.b), s, figures[0], what);
    } else {
      check_panel<2>(p, kernel_body(p.a), kernel_body(p.b), s, figures[1], what);
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    PanelFigures& f = figures[i];
    fmt::print(
        "panels of dimension {}: {}, third order known for {}, sharper for {}\n"
        "  (least sample - bound)/size, Lipschitz and slope  {}\n  with the third order  {}\n",
        i + 1, f.panels, f.curved, f.sharper, f.first.summary(), f.third.summary());
    EXPECT_GT(f.sharper, f.panels / 20);
    EXPECT_GE(f.third.quantile(0.0), -1e-12);
  }
}

/// Distance field of a torus to fifty digits: the surface of revolution in its own frame.
Digits50 field_value(const Torus& t, const Point<Digits50>& x)
{
  const Digits50 X = sqrt(x[0] * x[0] + x[1] * x[1]) - Digits50(t.R);
  if (t.round()) return sqrt(X * X + x[2] * x[2]) - Digits50(t.r0);
  return profile_distance<Digits50>(Digits50(t.r0), Digits50(t.r1), X, x[2]).distance;
}

TEST(PanelBound, FieldCurvatureBoundsTheDerivativesInItsBall)
{
  std::mt19937_64 rng(20263);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  long known = 0;
  Sample second_share, third_share;
  for (int k = 0; k < 1500; ++k) {
    Torus t;
    t.r0 = std::pow(10.0, -2.0 + 1.8 * uniform(rng));
    t.r1 = k % 4 == 0 ? t.r0 : t.r0 * std::pow(30.0, 2.0 * uniform(rng) - 1.0);
    const Body body = kernel_body(t);
    // A centre at some height above the surface, most often above the sharp ends of the profile; a ball that
    // may reach inside.
    const double v = k % 2 == 0 ? 2.0 * std::numbers::pi * uniform(rng)
                                : (t.r0 > t.r1 ? 0.0 : 0.5 * std::numbers::pi) + 0.3 * (uniform(rng) - 0.5);
    const double u = 2.0 * std::numbers::pi * uniform(rng),
                 height = std::pow(10.0, -4.0 + 4.0 * uniform(rng));
    const Vec3 foot_point = t.surface(u, v);
    const Vec3 center = foot_point + height * foot(t, foot_point + 1e-6 * (foot_point - t.core(u))).normal;
    const FieldValue f = field_at(body, center);
    if (f.m.phi <= 0.0) continue;
    const double d = f.m.phi * std::pow(10.0, -2.0 + 2.3 * uniform(rng));
    const FieldCurvature bounds = field_curvature(body, f, d);
    if (!(bounds.third < std::numeric_limits<double>::infinity())) continue;
    ++known;
    const Vec3 at = center + 0.999 * d * std::cbrt(uniform(rng)) * any_direction(rng),
               along = any_direction(rng);
    // Central differences of five values, step h: errors of order h^2 and 1e-50/h^3.
    const Digits50 h = Digits50(1e-11) * t.r1;
    std::array<Digits50, 5> value;
    for (int i = -2; i <= 2; ++i) {
      Point<Digits50> x;
      for (int c = 0; c < 3; ++c) x[c] = Digits50(at[c]) + i * h * Digits50(along[c]);
      const int place = i + 2;
      value[place] = field_value(t, x);
    }
    const double second = ((value[1] - 2 * value[2] + value[3]) / (h * h)).convert_to<double>();
    const double third =
        ((value[4] - 2 * value[3] + 2 * value[1] - value[0]) / (2 * h * h * h)).convert_to<double>();
    const std::string what =
        fmt::format("torus r0 {} r1 {}, height {:.3g}, ball {:.3g}", t.r0, t.r1, f.m.phi, d);
    EXPECT_LE(std::abs(second), bounds.second * (1.0 + 1e-9)) << what;
    EXPECT_LE(std::abs(third), bounds.third * (1.0 + 1e-9)) << what;
    second_share.add(std::abs(second) / bounds.second);
    third_share.add(std::abs(third) / bounds.third);
  }
  fmt::print("field curvature in {} balls: second derivative/bound {}\n  third derivative/bound {}\n", known,
             second_share.summary(), third_share.summary());
  EXPECT_GT(known, 500);
  EXPECT_GT(third_share.quantile(1.0), 0.2);
}

}  // namespace
}  // namespace hauberk::brute
