/// How Ipopt is made to keep the contract. The known problems are solved in common/test/conformance_test.cpp.

#include "../ipopt_optimizer.hpp"
#include "../nlp.hpp"

#include <hauberk/conformance/known_problems.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk {
namespace {

using namespace conformance;

/// x0^2 + x1 over ranges of 4.
FunctionProblem bowl()
{
  FunctionProblem p = box(2, -2.0, 2.0);
  p.objective = [](const VectorXd& x, VectorXd& g) {
    g << 2.0 * x[0], 1.0;
    return x[0] * x[0] + x[1];
  };
  return p;
}

/// A walk that has begun, and what Ipopt sees of it.
struct Begun {
  Begun(OptimizationProblem& problem, const std::vector<double>& start, bool exact = false)
      : walk(problem, {}, recorder, start)
  {
    std::string why;
    EXPECT_TRUE(walk.begin(true, why)) << why;
    nlp = new IpoptNlp(walk, walk.problem().scaled(walk.accepted().x), IpoptSettings{}, exact);
  }
  Recorder recorder;
  Walk walk;
  Ipopt::SmartPtr<IpoptNlp> nlp;
};

TEST(IpoptNlp, ScalesVariablesAndObjective)
{
  FunctionProblem problem = bowl();
  Begun b(problem, {2.0, 0.0});  // unit 4
  const Eigen::Vector2d z(0.25, 0.0);
  Eigen::Vector2d gradient;
  double value = 0.0;
  EXPECT_TRUE(b.nlp->eval_f(2, z.data(), true, value));
  EXPECT_EQ(value, 0.25);  // (1^2 + 0)/4
  EXPECT_TRUE(b.nlp->eval_grad_f(2, z.data(), false, gradient.data()));
  EXPECT_EQ(gradient, Eigen::Vector2d(2.0, 1.0));  // (2, 1) * 4/4
}

TEST(IpoptNlp, WhereADerivativeIsAskedForIsAnIterate)
{
  FunctionProblem problem = hs71();
  Begun b(problem, {1, 5, 5, 1});
  const Eigen::Vector4d z = Eigen::Vector4d(1, 4, 4, 1) / 4.0;
  double value = 0.0;
  Eigen::Vector3d c;
  EXPECT_TRUE(b.nlp->eval_f(4, z.data(), true, value));
  EXPECT_TRUE(b.nlp->eval_g(4, z.data(), false, 3, c.data()));
  EXPECT_EQ(c, Eigen::Vector3d(-9.0, -6.0, 6.0));
  EXPECT_EQ(problem.accepted.size(), 1U);  // a trial
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> J;
  EXPECT_TRUE(b.nlp->eval_jac_g(4, z.data(), false, 3, 12, nullptr, nullptr, J.data()));
  EXPECT_EQ(J.row(0),
            4.0 * Eigen::RowVector4d(16.0, 4.0, 4.0, 16.0));  // of x0 x1 x2 x3 - 25, times the range
  EXPECT_EQ(problem.accepted.size(), 2U);
  EXPECT_EQ(b.recorder.iterates.size(), 2U);
  EXPECT_EQ(problem.evaluated.size(), 2U);
  EXPECT_EQ(problem.breach, "");
}

TEST(IpoptNlp, WhatIsNotSafeCannotBeEvaluatedAndIsAskedForOnceOnARay)
{
  FunctionProblem problem = bowl();
  int asked = 0;
  problem.safe = [&asked](const VectorXd&, const VectorXd& d) {
    ++asked;
    return std::min(1.0, 0.5 / std::abs(d[0]));
  };
  Begun b(problem, {2.0, 0.0});
  double value = 0.0;
  for (const double far : {2.0, 1.0}) {  // d0 = -2, -1
    const Eigen::Vector2d z((2.0 - far) / 4.0, 0.0);
    EXPECT_FALSE(b.nlp->eval_f(2, z.data(), true, value));
  }
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(problem.evaluated.size(), 1U);
  const Eigen::Vector2d near(1.5 / 4.0, 0.0);
  EXPECT_TRUE(b.nlp->eval_f(2, near.data(), true, value));
  EXPECT_EQ(asked, 2);  // the direction that it is evaluated on
  EXPECT_EQ(problem.breach, "");
}

TEST(IpoptNlp, TheHessianIsThatOfTheScaledLagrangian)
{
  FunctionProblem problem = hs71_equation();
  problem.hessian_offered = true;
  Begun b(problem, {1, 5, 5, 1}, true);  // ranges of 4, unit 16
  const Eigen::Vector4d x(1, 5, 5, 1), z = x / 4.0;
  const Eigen::Vector2d lambda(0.5, -0.25);
  Eigen::Matrix<double, 10, 1> lower;
  ASSERT_TRUE(
      b.nlp->eval_h(4, z.data(), false, 2.0, 2, lambda.data(), false, 10, nullptr, nullptr, lower.data()));
  // Ipopt's 2 f/16 + lambda . c.
  const Eigen::MatrixXd H = 16.0 * problem.hessian_function(x, 2.0 / 16.0, -lambda);
  Eigen::Index entry = 0;
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index k = 0; k <= i; ++k) EXPECT_NEAR(lower[entry++], H(i, k), 1e-12) << i << k;
  EXPECT_EQ(problem.breach, "");
}

TEST(Ipopt, UsesTheHessianAndGoesOnWhereItIsNotKnown)
{
  for (const int known : {1000000, 3}) {
    FunctionProblem problem = rosenbrock(-2.0, 2.0);
    problem.hessian_offered = true;
    const auto exact = problem.hessian_function;
    problem.hessian_function = [&problem, exact, known](const VectorXd& x, double weight, const VectorXd& l) {
      return problem.products > 2 * known ? Eigen::MatrixXd(Eigen::MatrixXd::Constant(2, 2, std::nan("")))
                                          : exact(x, weight, l);
    };
    Recorder recorder;
    const OptimizerResult r = IpoptOptimizer({}).minimize(problem, std::vector<double>{-1.2, 1.0}, recorder);
    EXPECT_EQ(r.status, "converged") << r.message;
    EXPECT_NEAR(r.value, 0.0, 1e-8);
    EXPECT_GT(problem.products, 4);
    EXPECT_EQ(problem.breach, "");
  }
}

TEST(IpoptNlp, AStopIsThrown)
{
  FunctionProblem problem = bowl();
  Begun b(problem, {1.0, 0.0});
  b.recorder.limit = 2;
  const Eigen::Vector2d z(0.0, 0.0);
  Eigen::Vector2d gradient;
  EXPECT_THROW(b.nlp->eval_grad_f(2, z.data(), true, gradient.data()), IpoptNlp::Stopped);
  EXPECT_EQ(b.walk.stopped(), Walk::Stop::observer);
}

/// A problem whose first trials seem better by 30 than they prove to be as iterates.
class Flattering final : public OptimizationProblem {
 public:
  explicit Flattering(FunctionProblem& truth) : truth_(truth) {}
  std::span<const double> lower() const override { return truth_.lower(); }
  std::span<const double> upper() const override { return truth_.upper(); }
  int constraint_count() const override { return 0; }
  int residual_count() const override { return 0; }
  bool residuals(std::span<const double>, std::span<double>, std::span<double>) override { return false; }
  void constraints(std::span<const double>, std::span<double>, std::span<double>) override {}
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override
  {
    return truth_.largest_safe_step(x, d);
  }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    Evaluation e = truth_.evaluate(x, want_gradient);
    if (accepted_ == 1 && !std::equal(x.begin(), x.end(), iterate_.begin(), iterate_.end())) e.value -= 30.0;
    return e;
  }
  void accept(std::span<const double> x) override
  {
    iterate_.assign(x.begin(), x.end());
    ++accepted_;
    truth_.accept(x);
  }

 private:
  FunctionProblem& truth_;
  std::vector<double> iterate_;
  int accepted_ = 0;
};

TEST(Ipopt, BeginsAnewWhereAnIterateIsNotWhatTheTrialWas)
{
  FunctionProblem truth = rosenbrock(-2.0, 2.0);
  Flattering problem(truth);
  Recorder recorder;
  const OptimizerResult r = IpoptOptimizer({}).minimize(problem, std::vector<double>{-1.2, 1.0}, recorder);
  // From 24.2; compared with a value below -5, no true one would be a gain.
  EXPECT_NEAR(r.value, 0.0, 1e-8) << r.message;
  EXPECT_EQ(r.status, "converged");
  EXPECT_LT(r.evaluations, 90);  // 113 where Ipopt only begins anew when it can go no further
  EXPECT_EQ(truth.breach, "");
}

TEST(Ipopt, LeavesTheBoundsAtTheStartAsFarAsItIsSafe)
{
  FunctionProblem problem = bowl();
  problem.safe = [&problem](const VectorXd&, const VectorXd& d) {
    return problem.accepted.size() > 1 ? 1.0 : std::min(1.0, 0.015 / d.norm());
  };
  Recorder recorder;
  const OptimizerResult r = IpoptOptimizer({}).minimize(problem, std::vector<double>{2.0, 2.0}, recorder);
  ASSERT_GE(problem.accepted.size(), 2U);
  // 1e-2 of the range is too far, a quarter of it is not.
  EXPECT_NEAR((problem.accepted[1] - Eigen::Vector2d(1.99, 1.99)).norm(), 0.0, 1e-12);
  EXPECT_EQ(problem.breach, "");
  EXPECT_NEAR(r.value, -2.0, 1e-5) << r.message;
}

TEST(Ipopt, PrintsNothing)
{
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  FunctionProblem problem = hs71();
  Recorder recorder;
  IpoptOptimizer({}).minimize(problem, std::vector<double>{1, 5, 5, 1}, recorder);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace hauberk
