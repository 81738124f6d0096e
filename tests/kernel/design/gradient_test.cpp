/// The design's gradient against re-solved differences at fixed stiffness, and its constraints against
/// differences of relaxed rest states.

#include "design/design_problem.hpp"
#include "tasks/design/evaluation_log.hpp"
#include "uneven_chainmail.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tuple>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

class DesignGradient : public ::testing::TestWithParam<DesignValue> {};

TEST_P(DesignGradient, ResolvedDifferencesConvergeToIt)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  DesignSpec design = spec();
  design.value = GetParam();
  LimitSettings limits;
  DesignProblem problem({scene, load, 0.0, limits, design, 1, [] { return true; }});
  const std::vector<double> x = problem.scene_variables();
  const auto at = problem.evaluate(x, true);
  ASSERT_TRUE(at.ok) << at.why;
  problem.accept(x);
  for (std::size_t v = 0; v < x.size(); ++v) {
    std::array<double, 2> error{};
    for (int j = 0; j < 2; ++j) {
      // Below the gaps at the last stage (about 1e-3 L = 5e-3 mm), and far enough above the noise of solved
      // limits (about 5e-9, from the quadrature of arcs), which differences divide by 2 h.
      const double h = 3.2e-3 / (1 << j);
      std::array<double, 2> f{};
      for (int side = 0; side < 2; ++side) {
        std::vector<double> y = x;
        y[v] += side == 0 ? h : -h;
        const auto e = problem.evaluate(y, false);
        ASSERT_TRUE(e.ok) << e.why;
        f[side] = e.value;
      }
      error[j] = std::abs((f[0] - f[1]) / (2.0 * h) - at.gradient[v]);
    }
    const double scale = std::abs(at.gradient[v]);
    EXPECT_GT(scale, 1e-4) << "variable " << v;
    EXPECT_LT(error[1], 0.35 * error[0]) << v << ": of " << scale;
    EXPECT_LT(error[1], 1e-3 * scale) << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Values, DesignGradient,
                         ::testing::Values(DesignValue::less_contact, DesignValue::plain),
                         [](const auto& info) {
                           return info.param == DesignValue::plain ? "plain" : "less_contact";
                         });

TEST(DesignResiduals, GiveTheObjectiveAndItsGradient)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  const DesignSpec design = spec();
  LimitSettings limits;
  DesignProblem problem({scene, load, 0.0, limits, design, 2, [] { return true; }});
  const std::vector<double> x = problem.scene_variables();
  ASSERT_EQ(problem.residual_count(), 2);
  std::vector<double> r(2), J(8);
  EXPECT_FALSE(problem.residuals(x, r, J)) << "not evaluated yet";
  const OptimizationProblem::Evaluation e = problem.evaluate(x, true);
  ASSERT_TRUE(e.ok);
  ASSERT_TRUE(problem.residuals(x, r, J));
  EXPECT_NEAR(0.5 * (r[0] * r[0] + r[1] * r[1]), e.value, 1e-15);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(J[i] * r[0] + J[4 + i] * r[1], e.gradient[i], 1e-14) << i;
}

/// A bound that is kept adds nothing, one that is not is a target.
TEST(DesignResiduals, OfBoundsThatAreKeptAreNone)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  DesignSpec design = spec();
  const auto evaluated = [&] {
    DesignProblem problem({scene, load, 0.0, LimitSettings{}, design, 2, [] { return true; }});
    const std::vector<double> x = problem.scene_variables();
    OptimizationProblem::Evaluation e = problem.evaluate(x, true);
    EXPECT_TRUE(e.ok) << e.why;
    std::vector<double> r(2), J(8);
    EXPECT_TRUE(problem.residuals(x, r, J));
    return std::tuple(e, r, J);
  };
  const auto [e, r, J] = evaluated();
  ASSERT_NE(r[0], 0.0);
  const bool beyond = r[0] > 0.0;
  design.targets[0].aim = beyond ? Aim::no_nearer : Aim::no_further;
  const auto [kept, kept_r, kept_J] = evaluated();
  EXPECT_NEAR(kept.value, 0.5 * r[1] * r[1], 1e-15);
  EXPECT_EQ(kept_r[0], 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(kept_J[i], 0.0) << i;
    EXPECT_NEAR(kept.gradient[i], J[4 + i] * r[1], 1e-14) << i;
  }
  design.targets[0].aim = beyond ? Aim::no_further : Aim::no_nearer;
  const auto [broken, broken_r, broken_J] = evaluated();
  EXPECT_EQ(broken.value, e.value);
  EXPECT_EQ(broken_r, r);
  EXPECT_EQ(broken_J, J);
}

TEST(DesignConstraints, HolesAreThePublishedOnes)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  const DesignSpec design = spec();
  LimitSettings limits;
  DesignProblem problem({scene, load, 0.0, limits, design, 1, [] { return true; }});
  const std::vector<double> x = problem.scene_variables();
  std::vector<double> c(problem.constraint_count()), J(c.size() * x.size());
  problem.constraints(x, c, J);
  // First link: ring 0's hole against ring 1's section, R_0 - r0_0 - r_1 - eps, both half-widths equal.
  EXPECT_NEAR(c[0] * 4.9, 4.85 - 1.10 - 1.14 - 0.3, 1e-12);
  EXPECT_NEAR(c[1] * 4.9, 4.85 - 1.10 - 1.14 - 0.3, 1e-12);
  EXPECT_NEAR(J[0] * 4.9, 1.0, 1e-12);
  EXPECT_NEAR(J[1] * 4.9, -1.0, 1e-12);
  EXPECT_NEAR(J[3] * 4.9, -1.0, 1e-12);
}

TEST(DesignConstraints, HolesThatNoDesignHasAreNamed)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  // Widest hole within the bounds: R - r_0 - r_1 = 6 - 0.6 - 0.6.
  for (const double clearance : {4.8 - 1e-9, 4.8 + 1e-6}) {
    DesignSpec design = spec();
    design.hole_clearance = clearance;
    DesignProblem problem({scene, load, 0.0, {}, design, 1, [] { return true; }});
    const std::string impossible = problem.impossible_hole();
    if (clearance < 4.8)
      EXPECT_EQ(impossible, "");
    else
      EXPECT_NE(impossible.find("at most 4.8 "), std::string::npos) << impossible;
  }
}

TEST(DesignConstraints, RestGapsFollowTheirLinearisation)
{
  // At a new design the rest state is predicted, and relaxed only where a gap is too small: with room, the
  // constraints are those of the predicted state, and differ from the linearisation by the second order.
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  DesignSpec design = spec();
  design.rest_clearance = 0.02;
  DesignProblem problem({scene, load, 0.0, LimitSettings{}, design, 1, [] { return true; }});
  const std::vector<double> x = problem.scene_variables();
  ASSERT_TRUE(problem.evaluate(x, true).ok);
  problem.accept(x);
  const std::size_t n = problem.constraint_count();
  std::vector<double> c0(n), c(n), J(n * x.size());
  problem.constraints(x, c0, J);
  const std::vector<double> d = {-0.3, 1.0, 0.5, -0.8};
  std::array<double, 3> error{};
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double h = 8e-3 / static_cast<double>(1U << k);
    std::vector<double> y = x;
    for (std::size_t v = 0; v < y.size(); ++v) y[v] += h * d[v];
    problem.constraints(y, c, {});
    for (std::size_t r = 0; r < n; ++r) {
      double linear = c0[r];
      for (std::size_t v = 0; v < y.size(); ++v) linear += h * d[v] * J[r * y.size() + v];
      error[k] = std::max(error[k], std::abs(c[r] - linear));
    }
  }
  EXPECT_GT(error[0], 1e-8);
  EXPECT_LT(error[1], 0.3 * error[0]) << error[0] << " " << error[1];
  EXPECT_LT(error[2], 0.3 * error[1]) << error[1] << " " << error[2];
}

TEST(DesignProblem, GoesBackToAnyIterateWithoutSolvingAgain)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  DesignProblem problem({scene, load, 0.0, LimitSettings{}, spec(), 1, [] { return true; }});
  const std::vector<double> first = problem.scene_variables();
  const double value = problem.evaluate(first, true).value;
  problem.accept(first);
  std::vector<double> x = first;
  for (int k = 0; k < 3; ++k) {
    x[0] += 0.02;
    ASSERT_TRUE(problem.evaluate(x, true).ok);
    problem.accept(x);
  }
  const long spent = problem.evaluations();
  problem.accept(first);
  EXPECT_EQ(problem.evaluate(first, true).value, value);
  EXPECT_EQ(problem.current().x, first);
  EXPECT_EQ(problem.evaluations(), spent);
  // What cannot be evaluated cannot be an iterate: rings this thick overlap at rest.
  std::vector<double> thick = first;
  thick[1] = thick[3] = 2.4;
  EXPECT_FALSE(problem.evaluate(thick, true).ok);
  EXPECT_THROW(problem.accept(thick), PluginError);
}

/// A sheet that cannot be computed while it is widened by more than a percent.
class Fragile final : public Sheet {
 public:
  bool broken = false;

 protected:
  std::pair<double, double> do_stretch_range(std::span<const double> macro) const override
  {
    if (broken && macro[0] > 0.01) throw ComputationError("too wide");
    return Sheet::do_stretch_range(macro);
  }
};

TEST(DesignProblem, ADesignThatCannotBeComputedIsAnEvaluationThatFailed)
{
  const SceneSpec scene = uneven_chainmail();
  Fragile load;
  DesignProblem problem({scene, load, 0.0, LimitSettings{}, spec(), 2, [] { return true; }});
  std::vector<double> x = problem.scene_variables();
  ASSERT_TRUE(problem.evaluate(x, true).ok);
  problem.accept(x);
  x[0] += 0.02;
  load.broken = true;
  const OptimizationProblem::Evaluation e = problem.evaluate(x, true);
  EXPECT_FALSE(e.ok);
  EXPECT_EQ(e.why, "no limit at 20 degrees: too wide");
  load.broken = false;
  x[0] += 0.01;
  EXPECT_TRUE(problem.evaluate(x, true).ok);
}

TEST(DesignProblem, AdjointsAreCounted)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  std::array<long, 2> evaluations{};
  for (const DesignValue value : {DesignValue::less_contact, DesignValue::plain}) {
    DesignSpec design = spec();
    design.value = value;
    DesignProblem problem({scene, load, 0.0, LimitSettings{}, design, 1, [] { return true; }});
    ASSERT_TRUE(problem.evaluate(problem.scene_variables(), true).ok);
    evaluations[value == DesignValue::plain ? 1 : 0] = problem.evaluations();
  }
  // The locked states are the same; an adjoint takes one Hessian and four gradients, the other one gradient.
  EXPECT_GT(evaluations[1], evaluations[0]);
}

/// What an optimizer does that tries two designs before it accepts the first, from the start on.
std::vector<double> try_two_accept_the_first(
    const fs::path& log, bool go_on,
    const EvaluationLog::Warn& warn = [](const std::string& w) { ADD_FAILURE() << w; })
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  EvaluationLog memory(log, "identity", go_on, warn);
  DesignProblem problem({scene, load, 0.0, LimitSettings{}, spec(), 1, [] { return true; }});
  problem.set_memory(&memory);
  std::vector<double> numbers;
  std::vector<double> first = problem.scene_variables();
  for (int k = 0; k < 6; ++k) {
    std::vector<double> second = first, next = first;
    second[0] += 0.02;
    next[3] -= 0.01;
    for (const std::vector<double>& x : {first, second}) {
      const OptimizationProblem::Evaluation e = problem.evaluate(x, true);
      EXPECT_TRUE(e.ok) << e.why;
      numbers.push_back(e.value);
      numbers.insert(numbers.end(), e.gradient.begin(), e.gradient.end());
    }
    problem.accept(first);
    numbers.push_back(problem.evaluate(first, true).value);  // the fifth one is looked at more closely
    for (const std::vector<WarmStart>& task : problem.current().warm) {
      for (const WarmStart& w : task) numbers.push_back(w.state.macro.sum());
    }
    first = next;
  }
  numbers.push_back(static_cast<double>(problem.evaluations()));
  return numbers;
}

std::string text_of(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(DesignMemory, HoldsForAnOptimizerThatAcceptsWhatItTriedFirst)
{
  const fs::path log = fs::path(::testing::TempDir()) / fmt::format("hauberk_memory_{}", ::getpid());
  const std::vector<double> whole = try_two_accept_the_first(log, false);
  const std::string all = text_of(log);
  std::string marks;
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < all.size(); begin = ends.back()) {
    marks += all[begin];
    ends.push_back(all.find('\n', begin) + 1);
  }
  EXPECT_EQ(marks, "hEESEESEESEESEEESEES");
  // Wherever it was cut off, the search and what is remembered of it come out the same.
  for (const std::size_t end : ends) {
    std::ofstream(log, std::ios::binary) << all.substr(0, end);
    EXPECT_EQ(try_two_accept_the_first(log, true), whole) << end;
    EXPECT_EQ(text_of(log), all) << end;
  }
  // Warm starts that are missing in the middle: what comes after them is not believed.
  std::ofstream(log, std::ios::binary) << all.substr(0, ends[2]) + all.substr(ends[3]);
  EXPECT_EQ(try_two_accept_the_first(log, true), whole);
  EXPECT_EQ(text_of(log), all);
  // Damage, wherever a number, its sign or the number of numbers is another one: told, and not believed.
  const std::size_t begin = ends[3], length = ends[4] - begin;
  for (const double share : {0.0, 0.02, 0.3, 0.9}) {
    std::string damaged = all;
    char& hit = damaged[begin + static_cast<std::size_t>(share * static_cast<double>(length))];
    hit = hit == '7' ? '8' : '7';
    std::ofstream(log, std::ios::binary) << damaged;
    std::string warning;
    EXPECT_EQ(try_two_accept_the_first(log, true, [&](const std::string& w) { warning += w; }), whole);
    EXPECT_NE(warning.find("line 5 is damaged; it and what follows are computed again"), std::string::npos)
        << warning;
    EXPECT_EQ(text_of(log), all);
  }
  fs::remove(log);
}

TEST(DesignProblem, OnlyWhatWasTriedFromTheIterateIsAccepted)
{
  const SceneSpec scene = uneven_chainmail();
  const Sheet load(2);
  DesignProblem problem({scene, load, 0.0, LimitSettings{}, spec(), 1, [] { return true; }});
  const std::vector<double> first = problem.scene_variables();
  std::vector<double> second = first;
  second[0] += 0.02;
  ASSERT_TRUE(problem.evaluate(first, true).ok);
  ASSERT_TRUE(problem.evaluate(second, true).ok);
  problem.accept(first);
  EXPECT_EQ(problem.current().x, first);
  EXPECT_THROW(problem.accept(second), PluginError);
}

}  // namespace
}  // namespace hauberk::test
