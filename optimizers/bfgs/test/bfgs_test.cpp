/// Parts of bfgs, and what it costs. The known problems are solved in common/test/conformance_test.cpp.

#include "../bfgs.hpp"

#include <hauberk/conformance/known_problems.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk {
namespace {

using namespace conformance;

TEST(LimitedMemory, IsBfgsWhileNothingIsForgotten)
{
  LimitedMemory all(0), some(3);
  all.reset(3, 2.0);
  some.reset(3, 2.0);
  const Eigen::Matrix3d A = Eigen::Vector3d(1.0, 4.0, 9.0).asDiagonal();
  for (int k = 0; k < 3; ++k) {
    const VectorXd s = Eigen::Vector3d(1.0, 0.5 * k, -0.3 * k);
    all.update(s, A * s);
    some.update(s, A * s);
  }
  EXPECT_EQ(all.matrix(), some.matrix());
}

TEST(LimitedMemory, ForgetsTheOldestStep)
{
  // After k steps of another function, three steps of this one are all it knows.
  LimitedMemory fresh(3), old(3);
  fresh.reset(3, 2.0);
  old.reset(3, 2.0);
  const Eigen::Matrix3d A = Eigen::Vector3d(1.0, 4.0, 9.0).asDiagonal();
  old.update(Eigen::Vector3d(1.0, 1.0, 1.0), 100.0 * Eigen::Vector3d(1.0, 2.0, 1.0));
  for (int k = 0; k < 3; ++k) {
    const VectorXd s = Eigen::Vector3d(1.0, 0.5 * k, -0.3 * k);
    if (k == 2) {
      EXPECT_GT((old.matrix() - fresh.matrix()).norm(), 1.0);
    }
    fresh.update(s, A * s);
    old.update(s, A * s);
  }
  EXPECT_EQ(fresh.matrix(), old.matrix());
}

OptimizerResult minimise(FunctionProblem& problem, const std::vector<double>& start, Recorder& recorder,
                         BfgsSettings settings = {})
{
  settings.tolerance = 1e-10;
  OptimizerResult result = Bfgs(settings).minimize(problem, start, recorder);
  EXPECT_EQ(problem.breach, "");
  return result;
}

TEST(Bfgs, CostsOfRosenbrock)
{
  FunctionProblem problem = rosenbrock(-2.0, 2.0);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {-1.2, 1.0}, recorder);
  EXPECT_EQ(r.status, "converged");
  EXPECT_LT(r.evaluations, 80);
  EXPECT_LE(recorder.iterates[1].step, 0.05 + 1e-12);  // initial_step
}

TEST(Bfgs, ScaleOfVariablesDoesNotMatter)
{
  FunctionProblem metres = rosenbrock(-2.0, 2.0);
  FunctionProblem micrometres = rosenbrock_in_units(1e-6);
  Recorder first, second;
  const OptimizerResult a = minimise(metres, {-1.2, 1.0}, first);
  const OptimizerResult b = minimise(micrometres, {-1.2e6, 1.0e6}, second);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_NEAR(b.x[0], 1e6 * a.x[0], 1.0);
}

TEST(Bfgs, ScaleOfTheObjectiveDoesNotMatter)
{
  for (const double factor : {1e-6, 1e6}) {
    FunctionProblem problem = hs71();
    const auto plain = problem.objective;
    problem.objective = [plain, factor](const VectorXd& x, VectorXd& g) {
      const double value = plain(x, g);
      g *= factor;
      return factor * value;
    };
    Recorder recorder;
    const OptimizerResult r = minimise(problem, {1, 5, 5, 1}, recorder);
    EXPECT_EQ(r.status, "converged") << r.message;
    EXPECT_NEAR(r.value / factor, 17.0140172891, 1e-6);
    EXPECT_LT(r.evaluations, 100);
  }
}

TEST(Bfgs, ConstraintsThatRuleATrialOutCostNoEvaluation)
{
  // A full step from the start runs far out of the disk; only its shortened part is evaluated.
  FunctionProblem problem = farthest_in_disk(20.0);
  Recorder recorder;
  const OptimizerResult r = minimise(problem, {0.1, -0.3}, recorder);
  EXPECT_EQ(r.status, "converged") << r.message;
  EXPECT_NEAR(r.value, -5.0, 1e-7);
  EXPECT_LT(r.evaluations, 20);
  for (const VectorXd& x : problem.evaluated) EXPECT_LT(x.norm(), 3.0);
}

TEST(BfgsSettingsOf, ContradictionsAreProblems)
{
  std::vector<Field> fields;
  bfgs_fields(fields);
  Node section;
  section.type = Node::Type::object;
  for (const Field& f : fields) {
    Node value;
    value.type = Node::Type::number;
    value.pointer = "/" + f.name;
    value.number = f.name == "initial_step" ? 0.8 : f.name == "min_step" ? 0.1 : 0.5;
    section.members.emplace_back(f.name, value);
  }
  Problems problems;
  EXPECT_EQ(make_bfgs(section, problems), nullptr);
  ASSERT_EQ(problems.list().size(), 2U);
  EXPECT_EQ(problems.list()[0].message, "initial_step must not be larger than max_step");
  EXPECT_EQ(problems.list()[1].message, "min_step must be at most a tenth of initial_step");
}

}  // namespace
}  // namespace hauberk
