/// What follows from the few calls that every load case gives.

#include "limits/limits.hpp"
#include "scenes.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace hauberk::test {
namespace {

/// A sheet that gives no more than it must, by a Sheet's own motion.
class BareSheet final : public LoadCase {
 protected:
  const std::vector<MacroInfo>& do_macros() const override { return sheet_.macros(); }
  int do_coordinate_count() const override { return sheet_.coordinate_count(); }
  int do_lattice_vectors() const override { return 2; }
  void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override
  {
    sheet_.position(macro, e, X, T, out);
  }
  void do_load(double theta, std::span<double> t) const override
  {
    sheet_.load(Direction::at_radians(theta), t);
  }

 private:
  Sheet sheet_;
};

/// Unknowns of two units; moves nothing.
class MixedUnits final : public LoadCase {
 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 0; }
  int do_lattice_vectors() const override { return 0; }
  void do_position(std::span<const double>, std::span<const double>, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override
  {
    out.x = X + T;
  }
  void do_load(double, std::span<double> t) const override { t[0] = 1.0; }

 private:
  std::vector<MacroInfo> macros_{{"strain", 0}, {"curvature", -1}};
};

TEST(LoadCaseDefaults, AreWhatASheetSaysOfItself)
{
  const BareSheet bare;
  const Sheet sheet;
  std::array<double, 3> metric{};
  bare.metric(metric);
  EXPECT_EQ(metric, (std::array<double, 3>{1.0, 1.0, 2.0}));
  EXPECT_EQ(bare.value_length_power(), 0);
  EXPECT_TRUE(bare.periodic());
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> strain(-1.5, 1.5), angle(0.0, 3.0);
  int admissible = 0;
  for (int k = 0; k < 1000; ++k) {
    const std::array<double, 3> macro{strain(rng), strain(rng), strain(rng)};
    EXPECT_EQ(bare.admissible(macro), sheet.admissible(macro));
    admissible += bare.admissible(macro) ? 1 : 0;
    const Direction direction = Direction::at_radians(angle(rng));
    EXPECT_NEAR(bare.value(direction, macro), sheet.value(direction, macro), 1e-15);
    if (!sheet.admissible(macro)) continue;
    const auto [lo, hi] = bare.stretch_range(macro);
    const auto [low, high] = sheet.stretch_range(macro);
    EXPECT_NEAR(lo, low, 1e-14);
    EXPECT_NEAR(hi, high, 1e-14);
  }
  EXPECT_GT(admissible, 100);
  EXPECT_LT(admissible, 900);
  EXPECT_FALSE(bare.admissible(std::array{0.0, std::nan(""), 0.0}));
  EXPECT_FALSE(MixedUnits().admissible(std::array{0.0, std::numeric_limits<double>::infinity()}));
}

TEST(LoadCaseDefaults, LimitsAreThoseOfTheSheet)
{
  const SceneSpec scene = chainmail(1, 1);
  LimitSettings settings;
  settings.lessons = false;
  std::vector<LimitTask> tasks;
  for (const double degrees : {0.0, 30.0})
    for (const Sense sense : {Sense::positive, Sense::negative})
      tasks.push_back({Direction::at_degrees(degrees), sense});
  const Sheet sheet;
  const BareSheet bare;
  const auto expected = compute_limits(make_model(scene, sheet, 0.0), scene, tasks, settings, 2, {});
  const auto found = compute_limits(make_model(scene, bare, 0.0), scene, tasks, settings, 2, {});
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    ASSERT_EQ(expected[k].status, LimitStatus::locked) << expected[k].message;
    ASSERT_EQ(found[k].status, LimitStatus::locked) << found[k].message;
    EXPECT_NEAR(*found[k].value, *expected[k].value, 1e-9);
  }
}

TEST(LoadCaseDefaults, UnknownsOfTwoUnitsLeaveTheValuesUnitOpen)
{
  EXPECT_THROW(MixedUnits().value_length_power(), PluginError);
}

}  // namespace
}  // namespace hauberk::test
