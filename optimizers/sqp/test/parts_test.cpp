/// The parts of the method on their own: Hessian update, step with relaxation, settings.

#include "../sqp.hpp"
#include "numerics/damped_bfgs.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <common/subproblem.hpp>

#include <random>

namespace hauberk {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(DampedBfgs, SecantConditionHoldsWhereCurvatureIsPositive)
{
  DampedBfgs hessian;
  hessian.reset(3, 2.0);
  EXPECT_TRUE(hessian.fresh());
  EXPECT_EQ(hessian.matrix(), MatrixXd(2.0 * MatrixXd::Identity(3, 3)));
  const Eigen::Vector3d s(1, 2, -1);
  const Eigen::Vector3d y(3, 4, -2);
  hessian.update(s, y);
  EXPECT_FALSE(hessian.fresh());
  EXPECT_NEAR((hessian.matrix() * s - y).norm(), 0.0, 1e-12);
}

TEST(DampedBfgs, LearnsAQuadratic)
{
  // With n conjugate steps BFGS has the Hessian of a quadratic.
  const Eigen::Vector3d curvature(1, 10, 100);
  DampedBfgs hessian;
  hessian.reset(3, 1.0);
  for (int k = 0; k < 3; ++k) {
    const VectorXd s = VectorXd::Unit(3, k);
    hessian.update(s, curvature.cwiseProduct(s));
  }
  EXPECT_NEAR((hessian.matrix() - MatrixXd(curvature.asDiagonal())).norm(), 0.0, 1e-10);
}

TEST(DampedBfgs, StaysPositiveDefiniteUnderNegativeCurvatureAndBadNumbers)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  DampedBfgs hessian;
  hessian.reset(5, 1.0);
  for (int k = 0; k < 300; ++k) {
    const VectorXd s = VectorXd::NullaryExpr(5, [&] { return normal(random); });
    const VectorXd y = VectorXd::NullaryExpr(5, [&] { return 1e3 * normal(random); });
    hessian.update(s, y);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(hessian.matrix());
    EXPECT_GT(spectrum.eigenvalues()[0], 0.5e-10 * spectrum.eigenvalues()[4]);
    EXPECT_EQ(hessian.matrix(), MatrixXd(hessian.matrix().transpose()));
  }
  const MatrixXd before = hessian.matrix();
  hessian.update(VectorXd::Zero(5), VectorXd::Ones(5));
  hessian.update(VectorXd::Ones(5), VectorXd::Constant(5, std::nan("")));
  EXPECT_EQ(hessian.matrix(), before);
}

TEST(Subproblem, RelaxesOnlyWhatContradicts)
{
  // d >= 2 is out of reach of |d| <= 1; the step goes as far as it can, and d >= -0.5 stays kept.
  Linearisation at{VectorXd::Constant(1, 3.0), Eigen::Vector2d(-2.0, 0.5), MatrixXd::Ones(2, 1)};
  const VectorXd one = VectorXd::Ones(1);
  const Step step = propose_step(MatrixXd::Identity(1, 1), at, -one, one, 0.0);
  ASSERT_TRUE(step.ok);
  EXPECT_TRUE(step.elastic);
  EXPECT_NEAR(step.d[0], 1.0, 1e-9);
  EXPECT_NEAR(step.model_violation, 1.0, 1e-9);
}

TEST(Subproblem, ConsistentConstraintsAreNotRelaxed)
{
  Linearisation at{VectorXd::Constant(1, 3.0), VectorXd::Constant(1, -0.75), MatrixXd::Ones(1, 1)};
  const VectorXd one = VectorXd::Ones(1);
  const Step step = propose_step(MatrixXd::Identity(1, 1), at, -one, one, 0.0);
  ASSERT_TRUE(step.ok);
  EXPECT_FALSE(step.elastic);
  EXPECT_NEAR(step.d[0], 0.75, 1e-14);
  EXPECT_NEAR(step.multipliers[0], 3.75, 1e-13);
}

TEST(Subproblem, EquationsHaveMultipliersOfEitherSignAndAreRelaxedOnTheirSide)
{
  const VectorXd one = VectorXd::Ones(1);
  for (const double side : {-1.0, 1.0}) {
    // side (d - c) = 0 with g = 3: d = c, and 3 + d = side multiplier.
    Linearisation at{VectorXd::Constant(1, 3.0), VectorXd::Constant(1, side * -0.75),
                     MatrixXd::Constant(1, 1, side), 1};
    const Step met = propose_step(MatrixXd::Identity(1, 1), at, -one, one, 0.0);
    ASSERT_TRUE(met.ok);
    EXPECT_NEAR(met.d[0], 0.75, 1e-14);
    EXPECT_NEAR(met.multipliers[0], side * 3.75, 1e-13);
    at.c *= 2.0;  // d = 1.5 is out of reach
    const Step nearest = propose_step(MatrixXd::Identity(1, 1), at, -one, one, 0.0);
    ASSERT_TRUE(nearest.ok);
    EXPECT_TRUE(nearest.elastic);
    EXPECT_NEAR(nearest.d[0], 1.0, 1e-9);
    EXPECT_NEAR(nearest.model_violation, 0.5, 1e-9);
  }
}

Node section(double initial_step, double max_step, double min_step)
{
  std::vector<Field> fields;
  sqp_fields(fields);
  Node node;
  node.type = Node::Type::object;
  for (const Field& field : fields) {
    Node value;
    value.type = Node::Type::number;
    if (field.kind == Field::Kind::choice) {
      value.type = Node::Type::string;
      value.string = field.choices.front();
    } else {
      value.number = std::stod(field.default_json);
    }
    if (field.name == "initial_step") value.number = initial_step;
    if (field.name == "max_step") value.number = max_step;
    if (field.name == "min_step") value.number = min_step;
    node.members.emplace_back(field.name, value);
  }
  return node;
}

TEST(SqpSettings, ContradictionsAreReportedTogether)
{
  Problems problems;
  EXPECT_NE(make_sqp(section(0.05, 0.5, 1e-7), problems), nullptr);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(make_sqp(section(0.6, 0.5, 0.1), problems), nullptr);
  ASSERT_EQ(problems.list().size(), 2U);
  EXPECT_EQ(problems.list()[0].message, "initial_step must not be larger than max_step");
  EXPECT_EQ(problems.list()[1].message, "min_step must be at most a tenth of initial_step");
}

TEST(SqpSettings, DefaultsOfTheFieldsAreThoseOfTheStruct)
{
  const SqpSettings settings;
  std::vector<Field> fields;
  sqp_fields(fields);
  const std::vector<double> expected = {static_cast<double>(settings.max_iterations),
                                        static_cast<double>(settings.max_evaluations),
                                        settings.tolerance,
                                        settings.constraint_tolerance,
                                        settings.initial_step,
                                        settings.max_step,
                                        settings.min_step};
  EXPECT_TRUE(settings.gauss_newton);
  std::size_t next = 0;
  for (const Field& field : fields) {
    if (field.kind == Field::Kind::choice) {
      EXPECT_EQ(field.default_json, "\"gauss_newton\"");
      continue;
    }
    ASSERT_LT(next, expected.size());
    EXPECT_EQ(std::stod(field.default_json), expected[next++]) << field.name;
  }
  EXPECT_EQ(next, expected.size());
}

}  // namespace
}  // namespace hauberk
