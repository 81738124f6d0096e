#include <hauberk/kit/jet.hpp>

#include <gtest/gtest.h>

#include <random>

namespace hauberk::test {
namespace {

using kit::Interval;
using kit::Jet;

/// A formula that uses every smooth function, far from where any of them is singular.
struct Smooth {
  template <class S>
  S operator()(const std::array<S, 3>& x) const
  {
    using std::exp, std::hypot, std::pow, std::sqrt, kit::square;
    const S a = sqrt(1.0 + square(x[0]) + x[1] * x[1]), b = exp(0.3 * x[2]) / (2.0 + x[0] * x[1]);
    return pow(a + b, 1.7) - 2.0 * hypot(x[0] + 2.0, x[2] - b) + (x[1] - 1.0) / a - pow(x[0], 3.0);
  }
};

template <class J>
J jet_at(const std::array<double, 3>& x)
{
  return Smooth()(std::array<J, 3>{J::variable(x[0], 0), J::variable(x[1], 1), J::variable(x[2], 2)});
}

TEST(Jet, IsTheTaylorPolynomialToItsOrder)
{
  // What the polynomial of order n misses falls as step^(n + 1).
  const std::array<double, 3> x{0.4, -0.7, 0.9}, w{0.6, -0.64, 0.48};
  const auto f = jet_at<Jet<double, 3, 4>>(x);
  for (int order = 1; order <= 4; ++order) {
    const auto missed = [&](double step) {
      std::array<double, 3> y = x;
      for (int k = 0; k < 3; ++k) y[k] += step * w[k];
      double sum = 0.0;
      for (std::size_t m = 0; m < f.c.size(); ++m) {
        const auto& e = Jet<double, 3, 4>::M::all[m];
        if (e[0] + e[1] + e[2] > order) continue;
        double term = f.c[m];
        for (int k = 0; k < 3; ++k) term *= std::pow(step * w[k], e[k]);
        sum += term;
      }
      return std::abs(Smooth()(y) - sum);
    };
    const double slope = std::log(missed(0.1) / missed(0.05)) / std::log(2.0);
    EXPECT_NEAR(slope, order + 1, 0.35) << order;
  }
}

TEST(Jet, LowerOrdersAgreeWithHigherOnes)
{
  const std::array<double, 3> x{0.4, -0.7, 0.9};
  const auto f = jet_at<Jet<double, 3, 3>>(x);
  const auto g = jet_at<Jet<double, 3, 2>>(x);
  const auto h = jet_at<Jet<double, 3, 1>>(x);
  EXPECT_NEAR(Smooth()(x), f.value(), 1e-14);
  for (std::size_t k = 0; k < g.c.size(); ++k) EXPECT_NEAR(g.c[k], f.c[k], 1e-14);
  for (std::size_t k = 0; k < h.c.size(); ++k) EXPECT_NEAR(h.c[k], f.c[k], 1e-14);
}

TEST(Jet, HasDerivativesOfClosedForms)
{
  using J = Jet<double, 2, 3>;
  const double x = 1.3, y = -0.4;
  const J f = J::variable(x, 0) * square(J::variable(y, 1)) * J::variable(x, 0);  // x^2 y^2
  EXPECT_DOUBLE_EQ(f.derivative(0), 2.0 * x * y * y);
  EXPECT_DOUBLE_EQ(f.derivative(0, 1), 4.0 * x * y);
  EXPECT_DOUBLE_EQ(f.derivative(1, 1), 2.0 * x * x);
  EXPECT_DOUBLE_EQ(f.derivative(0, 0, 1), 4.0 * y);
  EXPECT_DOUBLE_EQ(f.derivative(1, 1, 1), 0.0);
  const J g = sqrt(J::variable(x, 0)), h = pow(J::variable(x, 0), 0.5), e = exp(J::variable(x, 0) * 2.0);
  for (const J& root : {g, h}) {
    EXPECT_NEAR(root.derivative(0), 0.5 / std::sqrt(x), 1e-15);
    EXPECT_NEAR(root.derivative(0, 0), -0.25 * std::pow(x, -1.5), 1e-15);
    EXPECT_NEAR(root.derivative(0, 0, 0), 0.375 * std::pow(x, -2.5), 1e-15);
  }
  EXPECT_NEAR(e.derivative(0, 0, 0), 8.0 * std::exp(2.0 * x), 1e-13);
  const J quotient = 1.0 / J::variable(x, 0);
  EXPECT_NEAR(quotient.derivative(0, 0, 0), -6.0 / std::pow(x, 4.0), 1e-14);
  // Derivatives of whole powers exist at 0.
  const J cube = pow(J::variable(0.0, 1), 3.0);
  EXPECT_EQ(cube.derivative(1, 1), 0.0);
  EXPECT_EQ(cube.derivative(1, 1, 1), 6.0);
}

TEST(Jet, BranchesByValue)
{
  using J = Jet<double, 1, 2>;
  const J x = J::variable(0.5, 0);
  using std::clamp;
  EXPECT_EQ(abs(-x).derivative(0), 1.0);
  EXPECT_EQ(max(x, 0.2).derivative(0), 1.0);
  EXPECT_EQ(max(x, J(0.7)).derivative(0), 0.0);
  EXPECT_EQ(clamp(x, J(-0.1), J(0.1)).value(), 0.1);
  EXPECT_EQ(min(x * x, x).derivative(0), 1.0);
}

TEST(Jet, OfIntervalsHoldsDerivativesOverTheBox)
{
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 300; ++k) {
    const double half = 0.2 * std::abs(unit(rng));
    std::array<double, 3> center{}, point{};
    std::array<Jet<Interval, 3, 3>, 3> box;
    for (int i = 0; i < 3; ++i) {
      center[i] = 0.8 * unit(rng);
      box[i] = Jet<Interval, 3, 3>::variable({center[i] - half, center[i] + half}, i);
    }
    const auto range = Smooth()(box);
    for (int t = 0; t < 20; ++t) {
      for (int i = 0; i < 3; ++i) point[i] = center[i] + half * unit(rng);
      const auto f = jet_at<Jet<double, 3, 3>>(point);
      for (std::size_t m = 0; m < f.c.size(); ++m) {
        const double rounding = 1e-13 * (1.0 + std::abs(f.c[m]));
        EXPECT_LE(range.c[m].lo, f.c[m] + rounding);
        EXPECT_GE(range.c[m].hi, f.c[m] - rounding);
      }
    }
  }
}

TEST(Jet, OfIntervalsIsTheHullWhereABranchIsUndecided)
{
  using J = Jet<Interval, 1, 2>;
  const J x = J::variable({-0.5, 1.0}, 0), high = max(x, 0.0), held = clamp(x, J(-0.2), J(0.2));
  EXPECT_EQ(high.value().lo, 0.0);
  EXPECT_EQ(high.value().hi, 1.0);
  EXPECT_EQ(high.slope(0).lo, 0.0);
  EXPECT_EQ(high.slope(0).hi, 1.0);
  EXPECT_EQ(held.value().lo, -0.2);
  EXPECT_EQ(held.value().hi, 0.2);
  EXPECT_EQ(abs(x).slope(0).lo, -1.0);
}

TEST(Jet, OfManySizesHasFirstDerivatives)
{
  using J = Jet<double, 8, 1>;
  J sum;
  for (int k = 0; k < 8; ++k) sum += (k + 1.0) * square(J::variable(0.1 * k, k));
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(sum.slope(k), 2.0 * (k + 1.0) * 0.1 * k, 1e-14);
}

}  // namespace
}  // namespace hauberk::test
