// Sensitivities of limits against limits solved again with changed parameters or clearance.

#include "counts.hpp"
#include "limit_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

/// Central difference of the value in parameter `p` of element `e`.
double resolved_again(const SceneSpec& scene, std::size_t e, std::size_t p, double direction, Sense sense,
                      double h)
{
  SceneSpec up = scene, down = scene;
  up.length = down.length = characteristic_length(scene);
  up.elements[e].parameters[p] += h;
  down.elements[e].parameters[p] -= h;
  return (*limit(up, direction, sense).value - *limit(down, direction, sense).value) / (2.0 * h);
}

double named(const LimitResult& r, const std::string& name)
{
  for (const auto& [key, value] : r.sensitivity_parameters) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no sensitivity " << name;
  return 0.0;
}

TEST(Sensitivity, OfAChainIsThatOfItsFormula)
{
  const SceneSpec scene = slack_chain({5, 0.7, 0.7}, {4, 0.5, 0.5});
  const double period = scene.lattice[0].x();
  const LimitResult r = limit(scene, 0.0, Sense::positive);
  ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
  // The last stage ends with forces balanced to about 1e-5 of the load.
  const double exact = 2.0 / period, margin = 1e-4 * exact;
  EXPECT_NEAR(named(r, "0/ring0.R"), exact, margin);
  EXPECT_NEAR(named(r, "1/ring0.R"), exact, margin);
  // A round tube in tension feels its half-width in the plane of both rings: R - r0.
  EXPECT_NEAR(named(r, "0/ring0.r0") + named(r, "0/ring0.r1"), -exact, margin);
  EXPECT_NEAR(*r.sensitivity_clearance, -exact, margin);
  const double h = 1e-3;
  const double cleared = (*limit(scene, 0.0, Sense::positive, {}, 2.0 * h).value - *r.value) / (2.0 * h);
  EXPECT_NEAR(cleared, -exact, 1e-6);
}

TEST(Sensitivity, OfTheThreefoldStretchIsThatOfItsFormula)
{
  const LimitResult r = limit(test::threefold_round(), 90.0, Sense::positive);
  ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
  const double one = 1.0 / test::threefold_spacing, margin = 1e-4 * one;
  EXPECT_NEAR(named(r, "0/ring0.R"), one, margin);
  EXPECT_NEAR(named(r, "0/ring1.R"), one, margin);
  EXPECT_NEAR(named(r, "0/ring2.R"), 0.0, margin);
  EXPECT_NEAR(*r.sensitivity_clearance, -one, margin);
  fmt::print("threefold stretch: relative error of the sensitivity to clearance {:.1e}\n",
             -*r.sensitivity_clearance / one - 1.0);
}

TEST(Sensitivity, OfChainmailAgreesWithSolvingAgain)
{
  // Rings differ, so that no limit is a kink; elliptical tubes, so that all three sizes count.
  SceneSpec scene = test::chainmail(1, 1);
  scene.elements[0].parameters = {4.93, 1.10, 1.06};
  scene.elements[1].parameters = {4.86, 1.13, 1.09};
  double worst = 0.0;
  std::vector<std::pair<double, Sense>> cases{{90.0, Sense::positive}};
  if (search_starts() > 1) {
    cases.insert(cases.end(), {{0.0, Sense::positive}, {40.0, Sense::positive}, {90.0, Sense::negative}});
  }
  for (const auto& [direction, sense] : cases) {
    const LimitResult r = limit(scene, direction, sense);
    ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
    double largest = 0.0;
    for (const auto& [key, value] : r.sensitivity_parameters) largest = std::max(largest, std::abs(value));
    for (std::size_t e = 0; e < 2; ++e) {
      const std::array<std::string, 3> names{"R", "r0", "r1"};
      for (std::size_t p = 0; p < 3; ++p) {
        const double stated = named(r, fmt::format("{}/ring0.{}", e, names[p]));
        const double again = resolved_again(scene, e, p, direction, sense, 2e-4);
        worst = std::max(worst, std::abs(stated - again) / largest);
        EXPECT_NEAR(stated, again, 2e-3 * largest) << direction << ' ' << e << ' ' << names[p];
      }
    }
    fmt::print(
        "chainmail {} {}: value {:.6f}, stated and solved-again sensitivities differ by {:.1e} of the "
        "largest\n",
        direction, r.sense, *r.value, worst);
    const double h = 2e-4;
    const double clearance = (*limit(scene, direction, sense, {}, h).value - *r.value) / h;
    worst = std::max(worst, std::abs(clearance - *r.sensitivity_clearance) / std::abs(clearance));
    EXPECT_NEAR(*r.sensitivity_clearance, clearance, 5e-3 * std::abs(clearance)) << direction;
  }
  fmt::print(
      "chainmail with unequal elliptical rings: stated and solved-again sensitivities differ by at most "
      "{:.1e}\n",
      worst);
}

/// Equal rings share the load in many ways: growing one leaves it to the contacts that gain least, shrinking
/// it to those that lose most.
TEST(Sensitivity, AtAKinkHasTwoSides)
{
  SceneSpec scene = test::chainmail(1, 1);
  scene.length = characteristic_length(scene);
  std::vector<std::pair<double, Sense>> cases{{0.0, Sense::positive}, {90.0, Sense::positive}};
  int kinks = 0;
  double widest = 0.0, worst = 0.0;
  for (const auto& [direction, sense] : cases) {
    const LimitResult r = limit(scene, direction, sense);
    ASSERT_EQ(r.status, LimitStatus::locked) << r.message;
    if (!r.kink) continue;
    ++kinks;
    ASSERT_EQ(r.parameters_one_sided.size(), r.sensitivity_parameters.size());
    double largest = 0.0;
    for (const auto& sides : r.parameters_one_sided)
      largest = std::max({largest, std::abs(sides[0]), std::abs(sides[1])});
    for (std::size_t k = 0; k < r.parameters_one_sided.size(); ++k) {
      const auto& [smaller, greater] = r.parameters_one_sided[k];
      const std::string& name = r.sensitivity_parameters[k].first;
      const double listed = r.sensitivity_parameters[k].second;
      EXPECT_GE(listed, std::min(smaller, greater) - 1e-3 * largest) << name;
      EXPECT_LE(listed, std::max(smaller, greater) + 1e-3 * largest) << name;
      widest = std::max(widest, std::abs(greater - smaller) / largest);
      for (const double h : {-2e-4, 2e-4}) {
        SceneSpec changed = scene;
        changed.elements[k / 3].parameters[k % 3] += h;
        const double again = (*limit(changed, direction, sense).value - *r.value) / h;
        worst = std::max(worst, std::abs(again - (h < 0.0 ? smaller : greater)) / largest);
        EXPECT_NEAR(again, h < 0.0 ? smaller : greater, 5e-3 * largest)
            << name << ' ' << direction << ' ' << h;
      }
    }
  }
  EXPECT_GT(kinks, 0);
  EXPECT_GT(widest, 0.1) << "no kink to speak of";
  fmt::print(
      "{} kinks: sides differ by up to {:.2f} of the largest sensitivity, and from limits solved again by "
      "{:.1e}\n",
      kinks, widest, worst);
}

}  // namespace
}  // namespace hauberk::brute
