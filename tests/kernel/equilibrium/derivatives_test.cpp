/// Derivatives of the contact energy in all unknowns and parameters, for every formulation and all pairs of
/// primitive kinds: central differences at several step sizes must converge with second order.

#include "contact/barrier.hpp"
#include "contact/body_pair.hpp"
#include "differences.hpp"
#include "equilibrium/stage.hpp"
#include "model/near_pairs.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hauberk::test {
namespace {

struct Case {
  const char* name;
  Formulation formulation;
  double r1_first, r1_second;  ///< r0 = 0.7
  Sides sides = Sides::both;

  ContactSettings settings(double clearance) const
  {
    ContactSettings s{formulation, 0.25, clearance};
    s.sides = sides;
    return s;
  }
};

class Derivatives : public ::testing::TestWithParam<Case> {};

TEST_P(Derivatives, GradientAndHessian)
{
  const Case& c = GetParam();
  const Sheet load(3);
  SceneSpec spec = chain({5, 0.7, c.r1_first}, {4.6, 0.7, c.r1_second}, 15.5);
  const Model m = make_model(spec, load, 0.01);
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal;
  const ContactSettings settings = c.settings(m.clearance);
  double largest = 0.0;
  for (int trial = 0; trial < 4; ++trial) {
    Vector dy(m.dofs());
    for (int k = 0; k < m.dofs(); ++k) dy[k] = 0.01 * normal(rng);
    const State s = advanced(m, rest_state(m), dy, 1.0);
    const auto pairs = near_pairs(m, s, 1.0);
    const ContactEnergy e = contact_energy(m, s, pairs, settings, {2, false, false});
    ASSERT_GT(e.min_gap, 0.0);
    ASSERT_GT(e.energy, 0.0);
    for (int k = 0; k < m.dofs(); ++k) dy[k] = normal(rng);
    std::array<double, 3> eg{}, eh{};
    for (int j = 0; j < 3; ++j) {
      const double h = 4e-4 / (1 << j);
      const ContactEnergy p = contact_energy(m, advanced(m, s, dy, h), pairs, settings, {1, false, false});
      const ContactEnergy q = contact_energy(m, advanced(m, s, dy, -h), pairs, settings, {1, false, false});
      eg[j] = std::abs((p.energy - q.energy) / (2 * h) - e.gradient.dot(dy));
      // Second derivative along the path exp(h w): its Hessian form is w^T H w.
      eh[j] = std::abs((p.energy - 2 * e.energy + q.energy) / (h * h) - dy.dot(e.hessian * dy));
    }
    const double slope = std::abs(e.gradient.dot(dy)), bend = std::abs(dy.dot(e.hessian * dy));
    largest = std::max(largest, slope);
    // Surface integrals carry the noise of 5-point panels that change from step to step.
    const bool surface = c.formulation == Formulation::arc && c.r1_first != 0.7 && c.r1_second != 0.7;
    expect_second_order(eg, std::max(slope, 1.0), surface ? 2e-5 : 2e-6);
    expect_second_order(eh, std::max(bend, 1.0), surface ? 5e-3 : 2e-4);
    EXPECT_LT((e.hessian - e.hessian.transpose()).norm(), 1e-12 * e.hessian.norm());
  }
  EXPECT_GT(largest, 0.1);
}

/// Mixed second derivatives: gradient differences against Hessian columns (translations and strains, where
/// the unknowns are a vector space).
TEST_P(Derivatives, HessianColumns)
{
  const Case& c = GetParam();
  const Sheet load(3);
  const Model m = make_model(chain({5, 0.7, c.r1_first}, {4.6, 0.7, c.r1_second}, 15.5), load, 0.01);
  const ContactSettings settings = c.settings(m.clearance);
  std::mt19937_64 rng(11);
  std::normal_distribution<double> normal;
  Vector dy(m.dofs());
  for (int k = 0; k < m.dofs(); ++k) dy[k] = 0.01 * normal(rng);
  const State s = advanced(m, rest_state(m), dy, 1.0);
  const auto pairs = near_pairs(m, s, 1.0);
  const ContactEnergy e = contact_energy(m, s, pairs, settings, {2, false, false});
  for (int k = 0; k < m.dofs(); ++k) {
    const bool rotation = k >= 3 && (k - 3) % 6 >= 3;
    if (rotation) continue;
    std::array<double, 3> error{};
    for (int j = 0; j < 3; ++j) {
      const double h = 4e-4 / (1 << j);
      Vector d = Vector::Unit(m.dofs(), k);
      const Vector p = contact_energy(m, advanced(m, s, d, h), pairs, settings, {1, false, false}).gradient;
      const Vector q = contact_energy(m, advanced(m, s, d, -h), pairs, settings, {1, false, false}).gradient;
      error[j] = ((p - q) / (2 * h) - e.hessian.col(k)).norm();
    }
    expect_second_order(error, std::max(e.hessian.col(k).norm(), 1.0), 2e-5);
  }
}

TEST_P(Derivatives, ParametersAndClearance)
{
  const Case& c = GetParam();
  const Sheet load(3);
  SceneSpec spec = chain({5, 0.7, c.r1_first}, {4.6, 0.7, c.r1_second}, 15.5);
  spec.length = 4.8;
  std::mt19937_64 rng(5);
  std::normal_distribution<double> normal;
  Model m = make_model(spec, load, 0.01);
  Vector dy(m.dofs());
  for (int k = 0; k < m.dofs(); ++k) dy[k] = 0.01 * normal(rng);
  const State s = advanced(m, rest_state(m), dy, 1.0);
  const auto pairs = near_pairs(m, s, 1.0);
  const ContactSettings settings = c.settings(m.clearance);
  const ContactEnergy e = contact_energy(m, s, pairs, settings, {1, true, false});
  const double scale = e.parameters.norm();
  ASSERT_GT(scale, 1e-3);
  for (int element = 0; element < 2; ++element) {
    // Tubes stay tubes: R, and r0 = r1 together; elliptical sections: each.
    const bool tube = (element == 0 ? c.r1_first : c.r1_second) == 0.7;
    std::vector<std::array<double, 3>> directions{{1, 0, 0}};
    if (tube) {
      directions.push_back({0, 1, 1});
    } else {
      directions.push_back({0, 1, 0});
      directions.push_back({0, 0, 1});
    }
    for (const auto& d : directions) {
      double expected = 0.0;
      for (int k = 0; k < 3; ++k) expected += e.parameters(k, element) * d[k];
      std::array<double, 3> error{};
      for (int j = 0; j < 3; ++j) {
        const double h = 2e-3 / (1 << j);
        std::array<double, 2> v{};
        for (int sign = 0; sign < 2; ++sign) {
          SceneSpec moved = spec;
          for (std::size_t k = 0; k < 3; ++k) {
            moved.elements[element].parameters[k] += (sign == 0 ? h : -h) * d[k];
          }
          const Model mm = make_model(moved, load, 0.01);
          v[sign] = contact_energy(mm, s, pairs, settings, {0, false, false}).energy;
        }
        error[j] = std::abs((v[0] - v[1]) / (2 * h) - expected);
      }
      expect_second_order(error, scale, 5e-6);
    }
  }
  std::array<double, 3> error{};
  for (int j = 0; j < 3; ++j) {
    const double h = 4e-4 / (1 << j);
    ContactSettings p = settings, q = settings;
    p.clearance += h;
    q.clearance -= h;
    const double d = (contact_energy(m, s, pairs, p, {0, false, false}).energy -
                      contact_energy(m, s, pairs, q, {0, false, false}).energy) /
                     (2 * h);
    error[j] = std::abs(d - e.d_clearance);
  }
  expect_second_order(error, std::abs(e.d_clearance), 5e-6);
}

/// Energy, gradient and Hessian of the published objective in the macroscopic unknowns: quadratic, so central
/// differences are exact but for rounding.
TEST(Objective, FiniteTarget)
{
  const Sheet load(3);
  const Model m = make_model(chain({5, 0.7, 0.7}, {4.6, 0.7, 0.7}, 15.5), load, 0.0);
  Stage stage;
  stage.contact = {Formulation::nearest, 1e-6, 0.0};  // nothing touches
  stage.target = 3.0;
  State s = rest_state(m);
  s.macro << 0.02, -0.01, 0.03;
  const Vector t = Eigen::Vector3d(0.7, 0.2, -0.4);
  const TotalEnergy e = total_energy(m, s, t, stage, {}, 2);
  // 1/2 |macro - T t|^2 / T without 1/2 T |t|^2.
  EXPECT_NEAR(e.energy, 0.5 * (s.macro - 3.0 * t).squaredNorm() / 3.0 - 1.5 * t.squaredNorm(), 1e-15);
  for (int k = 0; k < 3; ++k) {
    const double h = 1e-3;
    State p = s, q = s;
    p.macro[k] += h;
    q.macro[k] -= h;
    const double a = total_energy(m, p, t, stage, {}, 0).energy,
                 b = total_energy(m, q, t, stage, {}, 0).energy;
    EXPECT_NEAR(e.gradient[k], (a - b) / (2 * h), 1e-12);
    EXPECT_NEAR(e.hessian(k, k), (a - 2 * e.energy + b) / (h * h), 1e-8);
    EXPECT_NEAR(e.gradient[k], -driving_load(m, s, t, stage)[k], 1e-15);
  }
  stage.target = std::numeric_limits<double>::infinity();
  EXPECT_EQ(driving_load(m, s, t, stage), t);
  EXPECT_EQ(total_energy(m, s, t, stage, {}, 0).energy, -t.dot(s.macro));
}

/// One side is the smaller ring's, whatever its label; both sides are the mean of it and of the other one.
TEST(Sides, OneIsTheSmallerRingsAndBothAreTheMean)
{
  for (const double high : {0.15, 0.2}) {
    Primitive small, large;
    small.kind = large.kind = high == 0.15 ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
    small.size = {0.9, 0.15, high};
    large.size = {1.0, 0.15, high};
    const Body a = make_body(small, 0, 0, 1.0), b = make_body(large, 1, 0, 1.0);
    Pose at;
    at.position = Vec3(1.55, 0.03, 0.05);
    at.rotation = Eigen::AngleAxisd(1.4, Vec3(1.0, 0.2, 0.1).normalized()).toRotationMatrix();
    ContactSettings settings{Formulation::arc, 0.1, 0.0};
    const auto energy = [&settings](const Body& first, const Pose& p, const Body& second, const Pose& q) {
      return pair_contact(first, p, second, q, settings, 0).terms.energy;
    };
    const Request request{0, false, false};
    const double over_small = side_terms(PairFrame(a, Pose{}, b, at), settings, request, 1.0).energy;
    const double over_large = side_terms(PairFrame(b, at, a, Pose{}), settings, request, 1.0).energy;
    ASSERT_GT(over_small, 0.0);
    ASSERT_GT(std::abs(over_small - over_large), 1e-3 * over_small);
    EXPECT_NEAR(energy(a, Pose{}, b, at), 0.5 * (over_small + over_large), 1e-14 * over_small);
    settings.sides = Sides::one;
    EXPECT_EQ(energy(a, Pose{}, b, at), over_small);
    EXPECT_EQ(energy(b, at, a, Pose{}), over_small);
  }
}

TEST(Arc, RibbonIsTheLeastGapAroundEachCrossSection)
{
  // Independent of the search for strips: the least gap around each of many cross-sections, by the
  // trapezoidal rule.
  Primitive small, large;
  small.kind = large.kind = PrimitiveKind::revolved_ellipse;
  small.size = {0.9, 0.12, 0.2};
  large.size = {1.0, 0.18, 0.13};
  const Body P = make_body(small, 0, 0, 1.0), F = make_body(large, 1, 0, 1.0);
  Pose at;
  at.position = Vec3(1.36, 0.1, 0.12);
  at.rotation = Eigen::AngleAxisd(1.3, Vec3(1.0, 0.3, 0.2).normalized()).toRotationMatrix();
  const PairFrame frame(P, Pose{}, F, at);
  ContactSettings settings{Formulation::arc, 0.15, 0.0};
  settings.sides = Sides::ribbon;
  const Probe<2> probe(frame);
  double sum = 0.0, least_gap = 1.0;
  constexpr int n = 3000, around = 400;
  for (int i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n;
    const auto gap = [&](double v) { return field_at(F, probe.at(u, v).p).m.phi; };
    double best = 0.0, least = gap(0.0);
    for (int j = 1; j < around; ++j) {
      const double v = 2.0 * std::numbers::pi * j / around;
      if (gap(v) < least) least = gap(best = v);
    }
    double step = 2.0 * std::numbers::pi / around;
    for (; step > 1e-9; step *= 0.5)
      for (const double v : {best - step, best + step})
        if (gap(v) < least) least = gap(best = v);
    least_gap = std::min(least_gap, least);
    if (least >= settings.g_hat) continue;
    sum += barrier<1>(least, settings.g_hat).b * 2.0 * std::numbers::pi / n;
  }
  ASSERT_GT(least_gap, 0.01);
  ASSERT_LT(least_gap, 0.1);
  const double expected = sum / std::sqrt(settings.g_hat);
  const SideTerms found = side_terms(frame, settings, Request{0, false, false}, 1.0);
  EXPECT_NEAR(found.energy, expected, 1e-6 * expected);
  settings.quadrature = Quadrature::rough;
  EXPECT_NEAR(side_terms(frame, settings, Request{0, false, false}, 1.0).energy, expected, 1e-5 * expected);
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, Derivatives,
    ::testing::Values(Case{"arc_circle_circle", Formulation::arc, 0.7, 0.7},
                      Case{"arc_circle_ellipse", Formulation::arc, 0.7, 0.95},
                      Case{"arc_ellipse_ellipse", Formulation::arc, 0.5, 0.95},
                      Case{"arc_over_one_circle", Formulation::arc, 0.7, 0.7, Sides::one},
                      Case{"arc_over_one_ellipse", Formulation::arc, 0.5, 0.95, Sides::one},
                      Case{"arc_over_a_ribbon", Formulation::arc, 0.5, 0.95, Sides::ribbon},
                      Case{"nearest_circle_circle", Formulation::nearest, 0.7, 0.7},
                      Case{"nearest_circle_ellipse", Formulation::nearest, 0.7, 0.95},
                      Case{"nearest_ellipse_ellipse", Formulation::nearest, 0.5, 0.95},
                      Case{"published_circle_circle", Formulation::published, 0.7, 0.7},
                      Case{"published_circle_ellipse", Formulation::published, 0.7, 0.95},
                      Case{"published_ellipse_ellipse", Formulation::published, 0.5, 0.95}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hauberk::test
