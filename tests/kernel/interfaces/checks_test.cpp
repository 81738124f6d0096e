/// The checking calls in front of plugins: what they let through, and what they say about the rest.

#include <hauberk/error.hpp>
#include <hauberk/load_case.hpp>
#include <hauberk/optimizer.hpp>
#include <hauberk/shape.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace hauberk {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The message of the Error that `call` throws.
template <class Error>
std::string message(const std::function<void()>& call)
{
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "(nothing thrown)";
}

class AnyShape final : public Shape {
 public:
  std::vector<ParameterInfo> infos = {{"a.R", "length", 5.0, 1.0, 10.0, "", true}};
  std::vector<Primitive> answer = {
      {"a", PrimitiveKind::circle_tube, Vec3::Zero(), Mat3::Identity(), {5, 1, 1}, {}, {}, {}}};
  std::vector<PrimitiveJacobian> jacobian = {PrimitiveJacobian(6, 0.0)};

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return infos; }
  void do_primitives(std::span<const double>, std::vector<Primitive>& out) const override { out = answer; }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out = jacobian;
  }
};

const std::vector<double> five = {5.0};

TEST(ShapeChecks, SoundAnswersPass)
{
  const AnyShape shape;
  EXPECT_EQ(shape.primitives(five).size(), 1U);
  EXPECT_EQ(shape.jacobians(five).size(), 1U);
}

TEST(ShapeChecks, RowsOfTheRotationAreThereWhetherAnswered)
{
  AnyShape shape;
  EXPECT_EQ(shape.jacobians(five)[0], PrimitiveJacobian(9, 0.0));
  shape.jacobian[0] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(shape.jacobians(five)[0], shape.jacobian[0]);
}

TEST(ShapeChecks, Parameters)
{
  const AnyShape shape;
  EXPECT_EQ(message<PluginError>([&] {
              shape.primitives(std::vector<double>{1.0, 2.0});
            }),
            "shape: expected 1 parameters, found 2");
  EXPECT_EQ(message<InputError>([&] { shape.primitives(std::vector<double>{0.5}); }),
            "parameter 'a.R' = 0.5 is outside [1, 10]");
  EXPECT_EQ(message<InputError>([&] { shape.jacobians(std::vector<double>{std::nan("")}); }),
            "parameter 'a.R' = nan is outside [1, 10]");
}

TEST(ShapeChecks, Primitives)
{
  const auto with = [](const std::function<void(AnyShape&)>& change) {
    AnyShape shape;
    change(shape);
    return message<PluginError>([&] { shape.primitives(five); });
  };
  EXPECT_EQ(with([](AnyShape& s) { s.answer.clear(); }), "shape: no primitives returned");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].position.y() = infinity; }),
            "shape: primitive 'a' has a position that is not finite");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].rotation.col(0) *= -1.0; }),
            "shape: primitive 'a' has axes that are no rotation");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].rotation(0, 0) = std::nan(""); }),
            "shape: primitive 'a' has axes that are no rotation");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].size[2] = 0.0; }),
            "shape: primitive 'a' has a size that is not finite and positive");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].size[2] = 2.0; }),
            "shape: primitive 'a' is a circle tube with two radii");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].kind = PrimitiveKind::solid; }),
            "shape: primitive 'a' is a solid without one");
  EXPECT_EQ(with([](AnyShape& s) { s.answer[0].kind = static_cast<PrimitiveKind>(17); }),
            "shape: primitive 'a' is of the unknown kind 17");
}

TEST(ShapeChecks, Jacobians)
{
  AnyShape shape;
  shape.jacobian[0].push_back(0.0);
  EXPECT_EQ(message<PluginError>([&] { shape.jacobians(five); }),
            "shape: Jacobian of primitive 0 has 7 entries, expected 6, or 9 with those of its rotation");
  shape.jacobian[0].assign(6, std::nan(""));
  EXPECT_EQ(message<PluginError>([&] { shape.jacobians(five); }),
            "shape: Jacobian of primitive 0 is not finite");
  shape.jacobian.clear();
  EXPECT_EQ(message<PluginError>([&] { shape.jacobians(five); }), "shape: no Jacobians returned");
}

class AnyLoadCase final : public LoadCase {
 public:
  std::vector<MacroInfo> infos = {{"exx", 0}};
  int coordinates = 2;
  double x = 1.0;

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return infos; }
  int do_coordinate_count() const override { return coordinates; }
  int do_lattice_vectors() const override { return 2; }
  void do_position(std::span<const double>, std::span<const double>, const Vec3&, const Vec3&,
                   PositionMap& out) const override
  {
    out.x.x() = x;
  }
  bool do_admissible(std::span<const double>) const override { return true; }
  std::pair<double, double> do_stretch_range(std::span<const double>) const override { return {1.0, 1.0}; }
  void do_load(double, std::span<double>) const override {}
  double do_value(double, std::span<const double>) const override { return 0.0; }
  std::string do_measure() const override { return "any"; }
  int do_value_length_power() const override { return 0; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"up", "down"}; }
  void do_metric(std::span<double>) const override {}
  Boundedness do_boundedness(std::span<const double>, std::span<const Vec3>) const override
  {
    return Boundedness::attained;
  }
};

TEST(LoadCaseChecks, Position)
{
  AnyLoadCase load_case;
  PositionMap map;
  map.x.setConstant(7.0);
  map.J.setConstant(7.0);
  map.curved = true;
  const std::vector<double> one(1, 0.0);
  const std::vector<double> two(2, 0.0);
  const auto position = [&](const std::vector<double>& macro, const std::vector<double>& e) {
    return message<PluginError>([&] { load_case.position(macro, e, Vec3::Zero(), Vec3::Zero(), map); });
  };
  load_case.position(one, two, Vec3::Zero(), Vec3::Zero(), map);
  EXPECT_EQ(map.x, Vec3(1, 0, 0));  // nothing is left of what was there
  EXPECT_EQ(map.J.norm(), 0.0);
  EXPECT_FALSE(map.curved);
  EXPECT_EQ(position(two, two),
            "load case: expected 1 macroscopic unknowns and 2 coordinates, found 2 and 2");
  EXPECT_EQ(position(one, one),
            "load case: expected 1 macroscopic unknowns and 2 coordinates, found 1 and 1");
  load_case.x = std::nan("");
  EXPECT_EQ(position(one, two), "load case: the position of an element or its derivative is not finite");
  load_case.coordinates = 4;
  EXPECT_EQ(
      position(one, two),
      "load case: declares 1 macroscopic unknowns (at most 6) and 4 coordinates of an element (at most 3)");
}

TEST(LoadCaseChecks, Components)
{
  AnyLoadCase load_case;  // its metric is all zeros
  std::array<double, 1> t{};
  EXPECT_EQ(message<PluginError>([&] { load_case.load(Direction::along(std::array{2.0}), t); }),
            "load case: the metric gives the direction (2) no length");
  EXPECT_EQ(message<PluginError>([&] {
              load_case.load(Direction::along(std::array{2.0, 1.0}), t);
            }),
            "load case: expected a direction of 1 components, found 2");
  EXPECT_TRUE(load_case.takes_components());
  load_case.infos[0].length_power = -1;
  EXPECT_FALSE(load_case.takes_components()) << "another unit than the value";
  EXPECT_EQ(load_case.sense_name(Direction(), Sense::negative), "down");
  EXPECT_EQ(load_case.sense_name(Direction::along(std::array{2.0}), Sense::positive), "along");
  EXPECT_EQ(message<InputError>([] {
              Direction::along(std::array{0.0, 0.0});
            }),
            "a direction needs 1 to 6 finite components that are not all zero, found 2, all zero");
}

class AnyProblem final : public OptimizationProblem {
 public:
  std::vector<double> low = {0.0}, high = {1.0};
  int constraint_number = 0, equality_number = 0;

  std::span<const double> lower() const override { return low; }
  std::span<const double> upper() const override { return high; }
  int constraint_count() const override { return constraint_number; }
  int equality_count() const override { return equality_number; }
  Evaluation evaluate(std::span<const double> x, bool) override { return {true, 2.0 * x[0], {}, ""}; }
  int residual_count() const override { return 0; }
  bool residuals(std::span<const double>, std::span<double>, std::span<double>) override { return false; }
  void constraints(std::span<const double>, std::span<double>, std::span<double>) override {}
  double largest_safe_step(std::span<const double>, std::span<const double>) override { return 1.0; }
  void accept(std::span<const double>) override {}
};

class AnyOptimizer final : public Optimizer {
 public:
  OptimizerResult answer{"converged", "", {0.5}, 1.0, 0, 0};
  OptimizerTraits declared;

  OptimizerTraits traits() const override { return declared; }

 protected:
  OptimizerResult do_minimize(OptimizationProblem&, std::span<const double>,
                              OptimizerObserver&) const override
  {
    return answer;
  }
};

class Silent final : public OptimizerObserver {
 public:
  bool on_iterate(const OptimizerIterate&) override { return true; }
};

TEST(OptimizerChecks, Start)
{
  AnyProblem problem;
  Silent observer;
  const AnyOptimizer optimizer;
  const auto start = [&](const std::vector<double>& x) {
    return message<InputError>([&] { optimizer.minimize(problem, x, observer); });
  };
  EXPECT_EQ(start({0.5}), "(nothing thrown)");
  EXPECT_EQ(start({0.5, 0.5}), "optimizer: start has 2 variables, bounds have 1 and 1");
  EXPECT_EQ(start({2.0}), "optimizer: variable 0 starts at 2, outside its bounds [0, 1]");
  EXPECT_NE(start({std::nan("")}), "(nothing thrown)");
}

TEST(OptimizerChecks, EquationsThatItDoesNotKeep)
{
  AnyProblem problem;
  Silent observer;
  AnyOptimizer optimizer;
  const auto run = [&] {
    return message<InputError>([&] { optimizer.minimize(problem, std::vector<double>{0.5}, observer); });
  };
  problem.constraint_number = 3;
  EXPECT_EQ(run(), "(nothing thrown)");
  problem.equality_number = 1;
  EXPECT_EQ(
      run(),
      "optimizer: the problem has 1 equality constraint, and this one keeps none; choose one that does, which "
      "'hauberk plugins describe' tells of each");
  optimizer.declared.equalities = true;
  EXPECT_EQ(run(), "(nothing thrown)");
  problem.equality_number = 4;
  EXPECT_EQ(run(), "optimizer: 4 of the problem's 3 constraints are equations");
}

TEST(OptimizationProblem, BatchesAreOnePointAfterTheOther)
{
  AnyProblem problem;
  const auto found = problem.evaluate_batch(3, std::vector<double>{0.5, 0.25, 1.0}, false);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].value, 1.0);
  EXPECT_EQ(found[1].value, 0.5);
  EXPECT_EQ(found[2].value, 2.0);
  EXPECT_EQ(message<PluginError>([&] { problem.evaluate_batch(2, std::vector<double>(3), false); }),
            "optimizer: a batch of 2 points of 1 variables has 3 numbers, expected 2");
}

/// SplitMix64 from 0: the reference implementation's first numbers.
TEST(SeedOfStream, IsTheSeedAndThenMixedBits)
{
  EXPECT_EQ(seed_of_stream(0, 0), 0U);
  EXPECT_EQ(seed_of_stream(42, 0), 42U);
  EXPECT_EQ(seed_of_stream(0, 1), 0xe220a8397b1dcdafU);
  EXPECT_EQ(seed_of_stream(0, 2), 0x6e789e6aa1b965f4U);
}

TEST(OptimizerChecks, Result)
{
  const auto with = [](const std::function<void(OptimizerResult&)>& change) {
    AnyProblem problem;
    Silent observer;
    AnyOptimizer optimizer;
    change(optimizer.answer);
    return message<PluginError>([&] { optimizer.minimize(problem, std::vector<double>{0.5}, observer); });
  };
  EXPECT_EQ(with([](OptimizerResult& r) { r.status = "done"; }), "optimizer: unknown status 'done'");
  EXPECT_EQ(with([](OptimizerResult& r) { r.x.clear(); }), "optimizer: returned 0 variables, expected 1");
  EXPECT_EQ(with([](OptimizerResult& r) { r.x[0] = infinity; }), "optimizer: variable 0 is not finite");
  EXPECT_EQ(with([](OptimizerResult& r) { r.x[0] = -1.0; }),
            "optimizer: variable 0 = -1 is outside its bounds [0, 1]");
  EXPECT_EQ(with([](OptimizerResult& r) { r.value = std::nan(""); }), "optimizer: the value is not finite");
  EXPECT_EQ(with([](OptimizerResult& r) {
              r.status = "failed";
              r.value = std::nan("");
            }),
            "(nothing thrown)");
}

}  // namespace
}  // namespace hauberk
