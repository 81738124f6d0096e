#include <hauberk/kit/interval.hpp>
#include <hauberk/kit/taylor_model.hpp>

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

using kit::Interval;
using Model = kit::TaylorModel<3>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Intervals of many widths and magnitudes, often with 0 inside or at an end.
struct Intervals {
  std::mt19937_64 rng{11};

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }
  double bound()
  {
    if (uniform(0.0, 1.0) < 0.1) return 0.0;
    return std::copysign(std::exp(uniform(-8.0, 8.0)), uniform(-1.0, 1.0));
  }
  Interval next()
  {
    const double a = bound(), b = uniform(0.0, 1.0) < 0.2 ? a : bound();
    return {std::min(a, b), std::max(a, b)};
  }
  double inside(const Interval& x)
  {
    const double t = uniform(0.0, 1.0);
    if (t < 0.1) return x.lo;
    if (t > 0.9) return x.hi;
    return std::clamp(x.lo + t * (x.hi - x.lo), x.lo, x.hi);
  }
};

/// Values are of long double, so that rounding of the test's own arithmetic is below that of intervals.
void expect_inside(long double value, const Interval& x)
{
  if (std::isnan(value) || std::isinf(value)) return;
  EXPECT_LE(static_cast<long double>(x.lo), value);
  EXPECT_GE(static_cast<long double>(x.hi), value);
  EXPECT_FALSE(std::isnan(x.lo) || std::isnan(x.hi));
}

TEST(Interval, HoldsWhatItsPointsGive)
{
  Intervals draw;
  for (int k = 0; k < 100000; ++k) {
    const Interval a = draw.next(), b = draw.next();
    const long double x = draw.inside(a), y = draw.inside(b);
    expect_inside(x + y, a + b);
    expect_inside(x - y, a - b);
    expect_inside(x * y, a * b);
    if (y != 0.0L) expect_inside(x / y, a / b);
    expect_inside(-x, -a);
    expect_inside(x * x, square(a));
    if (x >= 0.0L) expect_inside(std::sqrt(x), sqrt(a));
    expect_inside(std::abs(x), abs(a));
    expect_inside(std::min(x, y), min(a, b));
    expect_inside(std::max(x, y), max(a, b));
    expect_inside(std::hypot(x, y), hypot(a, b));
    if (x < 100.0L) expect_inside(std::exp(x), exp(a));
    for (const double p : {2.0, 3.0, -1.0, -2.0, 4.0})
      expect_inside(std::pow(x, static_cast<long double>(p)), pow(a, p));
    for (const double p : {0.5, 1.5, -0.5})
      if (x > 0.0L) expect_inside(std::pow(x, static_cast<long double>(p)), pow(a, p));
    if (HasFailure()) FAIL() << a.lo << " " << a.hi << " and " << b.lo << " " << b.hi;
  }
}

TEST(Interval, IsTightToRounding)
{
  Intervals draw;
  for (int k = 0; k < 10000; ++k) {
    const Interval a = draw.next(), b = draw.next(), p = a * b, s = a + b;
    const double size = magnitude(a) * magnitude(b), sum = magnitude(a) + magnitude(b);
    const double least = std::min({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
    EXPECT_NEAR(p.lo, least, 3e-16 * size);
    EXPECT_NEAR(s.hi, a.hi + b.hi, 3e-16 * sum);
  }
}

TEST(Interval, KeepsZeroAndNeverGivesNaN)
{
  const Interval all = Interval::entire(), zero;
  EXPECT_TRUE((zero * all).is_zero());
  EXPECT_TRUE((zero + zero).is_zero());
  const Interval around{-1.0, 2.0};
  for (const Interval& x :
       {around / Interval(0.0, 1.0), around / Interval(-1.0, 1.0), 1.0 / zero, pow(around, -1.0)}) {
    EXPECT_EQ(x.lo, -infinity);
    EXPECT_EQ(x.hi, infinity);
  }
  for (const Interval& x :
       {all - all, all * all, all + Interval(infinity), square(all), sqrt(all), exp(all),
        Interval(0.0, infinity) * around, sqrt(Interval(-2.0, -1.0)), Interval(1e308, 1e308) * 10.0})
    EXPECT_FALSE(std::isnan(x.lo) || std::isnan(x.hi));
  EXPECT_EQ(mignitude(around), 0.0);
  EXPECT_EQ(magnitude(around), 2.0);
}

/// A model of a polynomial in s and t with a rest, and one of its members.
struct Member {
  Model model;
  std::array<double, Model::Polynomial::size> c{};
  double rest = 0.0;

  Member(Intervals& draw, double center, double width)
  {
    model = Model(center);
    c[0] = center;
    for (std::size_t k = 1; k < c.size(); ++k) model.p.c[k] = c[k] = width * draw.uniform(-0.3, 0.3);
    model.r = std::abs(width) * draw.uniform(0.0, 0.1);
    rest = model.r * draw.uniform(-1.0, 1.0);
    model.size = std::abs(center) + model.varies();
  }
  long double at(double s, double t) const
  {
    long double sum = rest;
    for (std::size_t k = 0; k < c.size(); ++k)
      sum += c[k] * std::pow(static_cast<long double>(s), Model::Polynomial::M::all[k][0]) *
             std::pow(static_cast<long double>(t), Model::Polynomial::M::all[k][1]);
    return sum;
  }
};

void expect_holds(const Model& m, long double value, double s, double t)
{
  if (!std::isfinite(m.r)) return;
  long double sum = 0.0L;
  for (std::size_t k = 0; k < m.p.c.size(); ++k)
    sum += m.p.c[k] * std::pow(static_cast<long double>(s), Model::Polynomial::M::all[k][0]) *
           std::pow(static_cast<long double>(t), Model::Polynomial::M::all[k][1]);
  EXPECT_LE(std::abs(value - sum), static_cast<long double>(m.r));
  EXPECT_LE(static_cast<long double>(lower(m)), value);
  EXPECT_GE(static_cast<long double>(upper(m)), value);
}

TEST(TaylorModel, HoldsWhatItsPointsGive)
{
  Intervals draw;
  for (int k = 0; k < 20000; ++k) {
    const double width = std::exp(draw.uniform(-20.0, 1.0));
    const Member x(draw, draw.uniform(-2.0, 2.0), width), y(draw, draw.uniform(-2.0, 2.0), width);
    const double s = draw.uniform(-1.0, 1.0), t = draw.uniform(-1.0, 1.0);
    const long double a = x.at(s, t), b = y.at(s, t);
    const Model &p = x.model, &q = y.model;
    expect_holds(p + q, a + b, s, t);
    expect_holds(p - q, a - b, s, t);
    expect_holds(p * q, a * b, s, t);
    expect_holds(p * 0.7, a * 0.7, s, t);
    expect_holds(p + 0.7, a + 0.7, s, t);
    expect_holds(p / q, a / b, s, t);
    expect_holds(square(p), a * a, s, t);
    expect_holds(sqrt(p), std::sqrt(std::max(0.0L, a)), s, t);
    expect_holds(exp(p), std::exp(a), s, t);
    expect_holds(abs(p), std::abs(a), s, t);
    expect_holds(max(p, q), std::max(a, b), s, t);
    expect_holds(min(p, q), std::min(a, b), s, t);
    expect_holds(hull(p, q), 0.3L * a + 0.7L * b, s, t);
    for (const double power : {3.0, 4.0, 5.0, -2.0, -3.0})
      expect_holds(pow(p, power), std::pow(a, static_cast<long double>(power)), s, t);
    if (a > 0.0L)
      for (const double power : {1.5, -0.5, 0.25})
        expect_holds(pow(p, power), std::pow(a, static_cast<long double>(power)), s, t);
    if (HasFailure()) FAIL() << p.center() << " width " << width;
  }
}

}  // namespace
}  // namespace hauberk::test
