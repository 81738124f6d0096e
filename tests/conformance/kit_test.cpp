/// The parts of the kit: differences, the choice of checks.

#include "deviations.hpp"

#include <hauberk/conformance/check.hpp>
#include <hauberk/conformance/known_problems.hpp>
#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hauberk::conformance {
namespace {

std::size_t wrong(const Along& f, double claimed) { return deviations(f, {&claimed, 1}, 0.1).size(); }

TEST(Differences, TellRightFromWrong)
{
  const Along sine = [](double s) { return std::vector<double>{std::sin(3.0 * (s + 0.4))}; };
  const double right = 3.0 * std::cos(1.2);
  EXPECT_EQ(wrong(sine, right), 0U);
  EXPECT_EQ(wrong(sine, right * (1.0 + 1e-6)), 1U);
  EXPECT_EQ(wrong(sine, -right), 1U);
  EXPECT_EQ(wrong(sine, std::nan("")), 1U);
  // At s = 0 its error of order h^2 is zero: the order is higher.
  const Along cubic = [](double s) { return std::vector<double>{1e3 + s * s * s * s * s + 2.0 * s}; };
  EXPECT_EQ(wrong(cubic, 2.0), 0U);
  EXPECT_EQ(wrong(cubic, 2.001), 1U);
  const Along affine = [](double s) { return std::vector<double>{7.0 - 0.3 * s}; };
  EXPECT_EQ(wrong(affine, -0.3), 0U);
  EXPECT_EQ(wrong(affine, -0.3 + 1e-8), 1U);
  const Along constant = [](double) { return std::vector<double>{0.0}; };
  EXPECT_EQ(wrong(constant, 0.0), 0U);
  EXPECT_EQ(wrong(constant, 1e-9), 1U);
}

/// R cos(pi/2) is 6e-17 R, and its derivative is rightly said to be 0.
TEST(Differences, TakeRoundingForNought)
{
  const Along corner = [](double s) {
    const double R = 5.0 + s;
    return std::vector<double>{R, R * std::cos(0.5 * std::numbers::pi)};
  };
  const std::vector<double> claimed{1.0, 0.0};
  EXPECT_TRUE(deviations(corner, claimed, 0.1).empty());
  const std::vector<double> wrong_by_little{1.0, 1e-8};
  EXPECT_EQ(deviations(corner, wrong_by_little, 0.1).size(), 1U);
}

TEST(Differences, KnowTheSlope)
{
  const Along sine = [](double s) { return std::vector<double>{std::sin(s + 0.5)}; };
  const double claimed = std::cos(0.5) + 1e-4;
  const std::vector<Deviation> found = deviations(sine, {&claimed, 1}, 0.1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].slope, 0.0, 0.1);
  EXPECT_NEAR(found[0].difference, std::cos(0.5), 1e-8);
  // |s| s^0.5 has the derivative 0 at 0, of which differences know nothing by symmetry; one-sided it is slope
  // 0.5.
  const Along rough = [](double s) { return std::vector<double>{s > 0.0 ? std::pow(s, 1.5) : 0.0}; };
  const double zero = 0.0;
  ASSERT_EQ(deviations(rough, {&zero, 1}, 0.1).size(), 1U);
  EXPECT_NEAR(deviations(rough, {&zero, 1}, 0.1)[0].slope, 0.5, 1e-6);
}

TEST(Checks, AreChosenByName)
{
  const std::vector<Check> all = checks(PluginKind::shape);
  EXPECT_EQ(matching(all, "").size(), all.size());
  ASSERT_EQ(matching(all, "^shape.jaco").size(), 1U);
  try {
    matching(all, "(");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("--filter: '(' is no regular expression: "), 0U) << error.what();
  }
  try {
    matching(all, "optimizer");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()).find("--filter: no check matches 'optimizer'; there are descriptor, "), 0U)
        << error.what();
  }
}

std::vector<double> lagrangian_gradient(KnownProblem& k, const VectorXd& x, const VectorXd& multipliers)
{
  VectorXd g(x.size());
  k.problem.objective(x, g);
  if (multipliers.size() > 0) {
    VectorXd c(multipliers.size());
    RowMajor J(multipliers.size(), x.size());
    k.problem.constraint_functions(x, c, J);
    g = 0.7 * g - J.transpose() * multipliers;
  } else {
    g *= 0.7;
  }
  return {g.begin(), g.end()};
}

/// Their Hessians are the derivatives of their gradients.
TEST(KnownProblems, HessiansAreDerivatives)
{
  int with = 0;
  for (KnownProblem& k : known_problems()) {
    if (!k.problem.hessian_function || k.name == "not_a_number") continue;
    ++with;
    const auto n = static_cast<Eigen::Index>(k.start.size());
    const VectorXd x = VectorXd::LinSpaced(n, 1.2, 1.9), v = VectorXd::LinSpaced(n, 0.5, -1.0);
    const VectorXd l = VectorXd::LinSpaced(k.problem.constraint_number, 0.3, 0.8);
    const VectorXd product = k.problem.hessian_function(x, 0.7, l) * v;
    const Along gradient = [&](double s) { return lagrangian_gradient(k, x + s * v, l); };
    const std::vector<double> claimed(product.begin(), product.end());
    EXPECT_TRUE(deviations(gradient, claimed, 0.1).empty()) << k.name;
    std::vector<double> wrong = claimed;
    wrong[0] += 1e-4 * (1.0 + std::abs(wrong[0]));
    EXPECT_FALSE(deviations(gradient, wrong, 0.1).empty()) << k.name;
  }
  EXPECT_EQ(with, 15);
}

/// Every point of a batch may be accepted, and residuals belong to a point that was evaluated by itself.
TEST(FunctionProblem, KnowsWhatWasEvaluatedLast)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  const std::vector<double> start{-1.2, 1.0}, d{0.1, 0.1};
  problem.evaluate(start, true);
  problem.accept(start);
  EXPECT_EQ(problem.largest_safe_step(start, d), 1.0);
  problem.backwards = true;
  const auto found = problem.evaluate_batch(2, std::vector<double>{-1.1, 1.1, -1.15, 1.05}, false);
  VectorXd g(2);
  EXPECT_EQ(found[0].value, problem.objective(Eigen::Vector2d(-1.1, 1.1), g));
  EXPECT_EQ(problem.evaluated.back(), Eigen::Vector2d(-1.1, 1.1));
  problem.accept(std::vector<double>{-1.15, 1.05});
  EXPECT_EQ(problem.breach, "");
  problem.accept(start);
  EXPECT_EQ(problem.breach, "it accepted another point than was evaluated last (evaluation 4)");
}

}  // namespace
}  // namespace hauberk::conformance
