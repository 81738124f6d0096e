#include "guarded.hpp"
#include "support.hpp"

#include <hauberk/error.hpp>

#include <array>
#include <cmath>
#include <stdexcept>

namespace hauberk::test {
namespace {

/// Answers every question with something else, so that mixed-up calls show; or throws in each of them.
class Odd final : public LoadCase {
 public:
  explicit Odd(bool fail) : fail_(fail) {}

 protected:
  using Values = std::span<const double>;

  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 2; }
  int do_lattice_vectors() const override { return 2; }
  void do_position(Values macro, Values e, const Vec3& X, const Vec3& T, PositionMap& out) const override
  {
    maybe_fail();
    out.x = X + macro[0] * T + Vec3(e[0], e[1], 0.0);
    out.J(2, 1) = 5.0;
  }
  double do_acceleration_bound(Values macro, Values dmacro, Values e, Values de, const Vec3& X,
                               const Vec3& T) const override
  {
    maybe_fail();
    return macro[0] + 10 * dmacro[0] + 100 * e[0] + 1e3 * de[0] + 1e4 * X.x() + 1e5 * T.x();
  }
  bool do_admissible(Values macro) const override
  {
    maybe_fail();
    return macro[0] > 0;
  }
  std::pair<double, double> do_stretch_range(Values macro) const override
  {
    maybe_fail();
    return {macro[0], macro[0] + 1};
  }
  void do_load(double theta, std::span<double> t) const override
  {
    maybe_fail();
    t[0] = theta;
  }
  double do_value(double theta, Values macro) const override
  {
    maybe_fail();
    return theta + 10 * macro[0];
  }
  std::string do_measure() const override
  {
    maybe_fail();
    return "odd";
  }
  int do_value_length_power() const override
  {
    maybe_fail();
    return -3;
  }
  std::vector<std::pair<std::string, double>> do_companions(double theta, Values macro) const override
  {
    maybe_fail();
    return {{"c", theta - macro[0]}};
  }
  std::pair<std::string, std::string> do_sense_names() const override
  {
    maybe_fail();
    return {"push", "pull"};
  }
  void do_metric(std::span<double> m) const override
  {
    maybe_fail();
    m[0] = 8.0;
  }
  std::vector<LinearInequality> do_inequalities(std::span<const Vec3> X) const override
  {
    maybe_fail();
    return {{"wall", {{1, 0, 2.0}}, static_cast<double>(X.size())}};
  }
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override
  {
    maybe_fail();
    return {{"held", {{0, 1, static_cast<double>(X.size())}}}};
  }
  bool do_transform(const Mat3& O, Values macro, std::span<double> out) const override
  {
    maybe_fail();
    out[0] = O(0, 1) * macro[0];
    return O(2, 2) > 0.0;
  }
  Boundedness do_boundedness(Values load, std::span<const Vec3> cycles) const override
  {
    maybe_fail();
    return load[0] < 0 && cycles.size() == 2 ? Boundedness::not_attained : Boundedness::attained;
  }
  bool do_bends() const override
  {
    maybe_fail();
    return true;
  }
  std::string do_not_a_sheet(const SheetState& state) const override
  {
    maybe_fail();
    return state.X.size() == 2 && state.linked.size() == 1 ? "torn" : "";
  }
  std::vector<StricterLoadCase> do_stricter() const override
  {
    maybe_fail();
    std::vector<StricterLoadCase> out;
    out.push_back({"more", std::make_unique<Odd>(false)});
    return out;
  }
  bool do_contains(const LoadCase& other) const override
  {
    maybe_fail();
    return dynamic_cast<const Odd*>(&other) != nullptr;
  }

 private:
  void maybe_fail() const
  {
    if (fail_) throw std::runtime_error("odd");
  }

  bool fail_;
  std::vector<MacroInfo> macros_{{"m", -1}};
};

std::unique_ptr<LoadCase> guarded(bool fail)
{
  return guard_load_case(std::make_unique<Odd>(fail), Guard("odd"));
}

constexpr std::array<double, 1> macro{0.5};
constexpr std::array<double, 1> dmacro{0.25};
constexpr std::array<double, 2> e{3.0, 4.0};
constexpr std::array<double, 2> de{6.0, 7.0};
const Vec3 X(1, 2, 3), T(10, 20, 30);
const std::array<Vec3, 2> both{X, T};
const Direction turned = Direction::at_radians(0.75);

TEST(GuardedLoadCase, AnswersComeThrough)
{
  const auto load_case = guarded(false);
  EXPECT_EQ(load_case->macros().size(), 1u);
  EXPECT_EQ(load_case->macros()[0].length_power, -1);
  EXPECT_EQ(load_case->coordinate_count(), 2);
  EXPECT_TRUE(load_case->periodic());
  PositionMap map;
  load_case->position(macro, e, X, T, map);
  EXPECT_EQ(map.x, Vec3(9, 16, 18));
  EXPECT_EQ(map.J(2, 1), 5.0);
  EXPECT_EQ(load_case->acceleration_bound(macro, dmacro, e, de, X, T), 0.5 + 2.5 + 300 + 6e3 + 1e4 + 1e6);
  EXPECT_TRUE(load_case->admissible(macro));
  EXPECT_FALSE(load_case->admissible(std::array{-1.0}));
  EXPECT_EQ(load_case->stretch_range(macro), std::pair(0.5, 1.5));
  std::array<double, 1> out{};
  load_case->load(turned, out);
  EXPECT_EQ(out[0], 0.75);
  EXPECT_EQ(load_case->value(turned, macro), 5.75);
  const Mat3 turn = rotation_exp(Vec3(0, 0, -0.5 * std::numbers::pi));
  EXPECT_TRUE(load_case->transform(turn, macro, out));
  EXPECT_NEAR(out[0], 0.5, 1e-15);
  EXPECT_FALSE(load_case->transform(-turn, macro, out));
  EXPECT_EQ(load_case->measure(), "odd");
  EXPECT_EQ(load_case->value_length_power(), -3);
  EXPECT_EQ(load_case->companions(turned, macro), (std::vector<std::pair<std::string, double>>{{"c", 0.25}}));
  EXPECT_EQ(load_case->sense_names(), (std::pair<std::string, std::string>{"push", "pull"}));
  load_case->metric(out);
  EXPECT_EQ(out[0], 8.0);
  const std::vector<LinearInequality> walls = load_case->inequalities(both);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].terms[0].coefficient, 2.0);
  EXPECT_EQ(walls[0].offset, 2.0);
  const std::vector<LinearEquality> held = load_case->equalities(both);
  ASSERT_EQ(held.size(), 1u);
  EXPECT_EQ(held[0].terms[0].coefficient, 2.0);
  EXPECT_EQ(load_case->boundedness(turned, Sense::negative, both), Boundedness::not_attained);
  EXPECT_EQ(load_case->boundedness(turned, Sense::positive, both), Boundedness::attained);
  const std::array<std::array<int, 2>, 1> linked{{{0, 1}}};
  EXPECT_TRUE(load_case->bends());
  EXPECT_EQ(load_case->not_a_sheet({macro, e, both, {}, linked}), "torn");
  EXPECT_EQ(load_case->not_a_sheet({macro, e, both, {}, {}}), "");
  ASSERT_EQ(load_case->stricter().size(), 1U);
  EXPECT_EQ(load_case->stricter()[0].name, "more");
  EXPECT_TRUE(load_case->contains(*load_case->stricter()[0].load)) << "guards know what they guard";
  EXPECT_TRUE(load_case->contains(Odd(false)));
}

TEST(GuardedLoadCase, EveryCallIsGuarded)
{
  const auto load_case = guarded(true);
  const auto expect = [](const char* call, auto&& f) {
    EXPECT_EQ(message_of<PluginError>(f), "plugin 'odd': " + std::string(call) + " failed: odd");
  };
  PositionMap map;
  std::array<double, 1> out{};
  expect("position", [&] { load_case->position(macro, e, X, T, map); });
  expect("acceleration_bound", [&] { load_case->acceleration_bound(macro, dmacro, e, de, X, T); });
  expect("admissible", [&] { load_case->admissible(macro); });
  expect("stretch_range", [&] { load_case->stretch_range(macro); });
  expect("load", [&] { load_case->load(Direction(), out); });
  expect("value", [&] { load_case->value(Direction(), macro); });
  expect("measure", [&] { load_case->measure(); });
  expect("value_length_power", [&] { load_case->value_length_power(); });
  expect("companions", [&] { load_case->companions(Direction(), macro); });
  expect("sense_names", [&] { load_case->sense_names(); });
  expect("metric", [&] { load_case->metric(out); });
  expect("bends", [&] { load_case->bends(); });
  expect("not_a_sheet", [&] { load_case->not_a_sheet({}); });
  expect("stricter", [&] { load_case->stricter(); });
  expect("contains", [&] { load_case->contains(Odd(false)); });
  expect("inequalities", [&] { load_case->inequalities(both); });
  expect("equalities", [&] { load_case->equalities(both); });
  expect("boundedness", [&] { load_case->boundedness(std::array{1.0}, both); });
}

}  // namespace
}  // namespace hauberk::test
