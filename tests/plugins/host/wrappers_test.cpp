#include "support.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/factories.hpp>
#include <hauberk/host/floating_point.hpp>
#include <hauberk/host/plugin_library.hpp>

#include <algorithm>
#include <chrono>
#include <clocale>
#include <condition_variable>
#include <functional>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace hauberk::test {
namespace {

Node text(const std::string& value)
{
  Node node;
  node.type = Node::Type::string;
  node.string = value;
  return node;
}

Node flag(bool value)
{
  Node node;
  node.type = Node::Type::boolean;
  node.boolean = value;
  return node;
}

struct Member {
  const char* key;
  Node value;
};

Node object(const std::vector<Member>& members)
{
  Node node;
  node.type = Node::Type::object;
  node.pointer = "/section";
  node.line = 3;
  for (const Member& member : members) node.members.emplace_back(member.key, member.value);
  return node;
}

const PluginTable& throwing() { return PluginLibrary::load(bad("throwing")).table(); }

std::unique_ptr<Shape> make_throwing(const std::string& where, const std::string& how)
{
  Problems problems;
  return make_shape(throwing(), object({{"where", text(where)}, {"how", text(how)}}), problems);
}

TEST(Factories, ExceptionsNameThePluginAndTheCall)
{
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("make", "std"); }),
            "plugin 'throwing': make_shape failed: the dog ate it");
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("make", "int"); }),
            "plugin 'throwing': make_shape failed: it threw something that is no std::exception");
  EXPECT_EQ(message_of<InputError>([] { make_throwing("make", "input"); }), "ring.R: 3 is too small");
  EXPECT_EQ(message_of<PluginError>([] { plugin_fields(throwing()); }),
            "plugin 'throwing': fields failed: no fields today");
}

TEST(Factories, NullNeedsAProblem)
{
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("", "null"); }),
            "plugin 'throwing': make_shape returned nothing and reported no problem");
}

TEST(Factories, AProblemMeansNoObject)
{
  Problems problems;
  const Node section = object({{"where", text("")}, {"how", text("problem")}});
  EXPECT_EQ(make_shape(throwing(), section, problems), nullptr);
  ASSERT_EQ(problems.list().size(), 1u);
  EXPECT_EQ(problems.list()[0].pointer, "/section");
  EXPECT_EQ(problems.list()[0].line, 3);
  EXPECT_EQ(problems.list()[0].message, "expected something else");
}

TEST(Factories, EarlierProblemsDoNotCount)
{
  Problems problems;
  problems.add({"/other", 1, "elsewhere"});
  const Node section = object({{"where", text("")}, {"how", text("")}});
  EXPECT_NE(make_shape(throwing(), section, problems), nullptr);
}

TEST(Factories, GoodPluginWorks)
{
  Problems problems;
  const PluginLibrary library = PluginLibrary::load(bad("good_shape"));
  EXPECT_TRUE(plugin_fields(library.table()).empty());
  const auto shape = make_shape(library.table(), object({}), problems);
  ASSERT_NE(shape, nullptr);
  EXPECT_TRUE(shape->parameters().empty());
  const std::vector<Primitive> primitives = shape->primitives({});
  ASSERT_EQ(primitives.size(), 1u);
  EXPECT_EQ(primitives[0].R(), 5.0);
  EXPECT_EQ(shape->jacobians({}).size(), 1u);
}

TEST(GuardedShape, EveryCallIsGuarded)
{
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("parameters", "std"); }),
            "plugin 'throwing': parameters failed: the dog ate it");
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("primitives", "std")->primitives({}); }),
            "plugin 'throwing': primitives failed: the dog ate it");
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("jacobians", "plugin")->jacobians({}); }),
            "plugin 'throwing': jacobians failed: shape: 2 sizes expected");
  EXPECT_EQ(message_of<ComputationError>([] { make_throwing("primitives", "computation")->primitives({}); }),
            "no convergence");
}

TEST(GuardedShape, FloatingPointModeIsKept)
{
  const FloatingPointMode before = floating_point_mode();
  const std::string rest = "; it was restored, but what the call computed cannot be used";
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("primitives", "rounding")->primitives({}); }),
            "plugin 'throwing': primitives changed the floating-point mode (rounding)" + rest);
  EXPECT_EQ(floating_point_mode(), before);
#if defined(__x86_64__)
  EXPECT_EQ(message_of<PluginError>([] { make_throwing("primitives", "flush_to_zero")->primitives({}); }),
            "plugin 'throwing': primitives changed the floating-point mode (flush-to-zero)" + rest);
  EXPECT_EQ(floating_point_mode(), before);
#endif
  EXPECT_EQ(
      message_of<PluginError>([] { make_throwing("primitives", "rounding_and_throw")->primitives({}); }),
      "plugin 'throwing': primitives failed: the dog ate it");
  EXPECT_EQ(floating_point_mode(), before);
}

TEST(GuardedShape, ProcessStateIsKept)
{
  const fs::path directory = fs::current_path();
  const std::string rest = "); it was restored, but a plugin must leave it alone";
  const auto changed = [](const std::string& where, const std::string& how) {
    return message_of<PluginError>([&] {
      const auto shape = make_throwing(where, how);
      static_cast<void>(shape->primitives({}));
      static_cast<void>(shape->jacobians({}));
    });
  };
  const std::string begin = " changed the state of the process (";
  EXPECT_EQ(changed("make", "directory"),
            "plugin 'throwing': make_shape" + begin + "current directory" + rest);
  EXPECT_EQ(changed("primitives", "locale"), "plugin 'throwing': primitives" + begin + "locale" + rest);
  EXPECT_EQ(changed("jacobians", "precision"),
            "plugin 'throwing': jacobians" + begin + "state of std::cout" + rest);
  EXPECT_EQ(std::string(std::setlocale(LC_ALL, nullptr)), "C");
  EXPECT_EQ(std::cout.precision(), 6);
  EXPECT_EQ(changed("make", "directory_and_throw"), "plugin 'throwing': make_shape failed: the dog ate it");
  EXPECT_EQ(fs::current_path(), directory);
}

/// f(x) = x^2 on [0, 2]; evaluation throws when asked to.
class Parabola : public OptimizationProblem {
 public:
  explicit Parabola(bool fail) : fail_(fail) {}
  std::span<const double> lower() const override { return lower_; }
  std::span<const double> upper() const override { return upper_; }
  int constraint_count() const override { return 0; }
  Evaluation evaluate(std::span<const double> x, bool) override
  {
    if (fail_) throw std::out_of_range("a defect of the program");
    Evaluation evaluation;
    evaluation.ok = true;
    evaluation.value = x[0] * x[0];
    return evaluation;
  }
  int residual_count() const override { return 1; }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override
  {
    r[0] = std::sqrt(2.0) * x[0];
    jacobian[0] = std::sqrt(2.0);
    return true;
  }
  void constraints(std::span<const double>, std::span<double>, std::span<double>) override {}
  double largest_safe_step(std::span<const double>, std::span<const double>) override { return 1.0; }
  void accept(std::span<const double>) override {}

 private:
  bool fail_;
  std::array<double, 1> lower_{0.0}, upper_{2.0};
};

class Silent final : public OptimizerObserver {
 public:
  bool on_iterate(const OptimizerIterate&) override { return true; }
};

std::unique_ptr<Optimizer> make_hasty(bool swallow, bool plugin_fails, bool thread_safe = true)
{
  Problems problems;
  return make_optimizer(
      PluginLibrary::load(bad("hasty_optimizer")).table(),
      object({{"swallow", flag(swallow)}, {"throw", flag(plugin_fails)}, {"thread_safe", flag(thread_safe)}}),
      problems);
}

OptimizerResult run_hasty(bool problem_fails, bool swallow, bool plugin_fails)
{
  const auto optimizer = make_hasty(swallow, plugin_fails);
  Parabola problem(problem_fails);
  Silent observer;
  const std::array<double, 1> start{1.5};
  return optimizer->minimize(problem, start, observer);
}

TEST(GuardedOptimizer, ResultComesThrough)
{
  const OptimizerResult result = run_hasty(false, false, false);
  EXPECT_EQ(result.value, 2.25);
  EXPECT_EQ(result.x, std::vector<double>{1.5});
}

TEST(GuardedOptimizer, ResidualsComeThrough)
{
  const OptimizerResult result = run_hasty(false, false, false);
  EXPECT_EQ(result.iterations, 1) << "the number of residuals";
  EXPECT_EQ(result.message, std::to_string(std::sqrt(2.0) * 1.5));
}

TEST(GuardedOptimizer, ItsOwnFailureIsThePlugins)
{
  EXPECT_EQ(message_of<PluginError>([] { run_hasty(false, false, true); }),
            "plugin 'hasty_optimizer': minimize failed: out of patience");
}

TEST(GuardedOptimizer, WhatTheProblemThrowsIsNotBlamedOnThePlugin)
{
  EXPECT_EQ(message_of<std::out_of_range>([] { run_hasty(true, false, false); }), "a defect of the program");
  // Neither is it lost when the plugin swallows it, or throws something else afterwards.
  EXPECT_EQ(message_of<std::out_of_range>([] { run_hasty(true, true, false); }), "a defect of the program");
  EXPECT_EQ(message_of<std::out_of_range>([] { run_hasty(true, true, true); }), "a defect of the program");
}

/// What a problem need not have.
class Rich final : public Parabola {
 public:
  Rich() : Parabola(false) {}
  int constraint_count() const override { return 3; }
  int equality_count() const override { return 2; }
  std::vector<Evaluation> evaluate_batch(std::size_t, std::span<const double>, bool) override
  {
    return {{true, 0.25, {}, ""}};
  }
  bool hessian_product(std::span<const double>, double weight, std::span<const double>,
                       std::span<const double> v, std::span<double> out) override
  {
    out[0] = 2.0 * weight * v[0];
    return true;
  }
  std::uint64_t stream() const override { return 4; }
};

TEST(GuardedOptimizer, WhatAProblemNeedNotHaveComesThrough)
{
  Rich problem;
  Silent observer;
  const OptimizerResult result = make_hasty(false, false)->minimize(problem, std::array{1.5}, observer);
  EXPECT_EQ(result.message, "0.25 2 4 3");
  EXPECT_TRUE(make_hasty(false, false, true)->traits().thread_safe);
  EXPECT_FALSE(make_hasty(false, false, false)->traits().thread_safe);
}

/// Counts how many evaluations go on at once: each waits for another one, as long as given.
struct Meeting {
  explicit Meeting(std::chrono::milliseconds most_wait) : wait(most_wait) {}

  void attend()
  {
    std::unique_lock lock(mutex);
    most = std::max(most, ++inside);
    changed.notify_all();
    changed.wait_for(lock, wait, [this] { return most > 1; });
    --inside;
  }

  std::chrono::milliseconds wait;
  std::mutex mutex;
  std::condition_variable changed;
  int inside = 0, most = 0;
};

class MeetingProblem final : public Parabola {
 public:
  explicit MeetingProblem(std::function<void()> meet) : Parabola(false), meet_(std::move(meet)) {}
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    meet_();
    return Parabola::evaluate(x, want_gradient);
  }

 private:
  std::function<void()> meet_;
};

/// Most evaluations at once of two runs of two optimizers of one library.
int most_at_once(bool thread_safe, std::chrono::milliseconds wait)
{
  Meeting meeting(wait);
  const auto run = [&] {
    MeetingProblem problem([&] { meeting.attend(); });
    Silent observer;
    make_hasty(false, false, thread_safe)->minimize(problem, std::array{1.5}, observer);
  };
  {
    const std::jthread other(run);
    run();
  }
  return meeting.most;
}

TEST(GuardedOptimizer, RunsOfALibraryThatIsNotThreadSafeWaitForEachOther)
{
  using namespace std::chrono_literals;
  EXPECT_EQ(most_at_once(true, 20s), 2);  // ends at once: both are there
  EXPECT_EQ(most_at_once(false, 50ms), 1);
}

TEST(GuardedOptimizer, AProblemMayStartARunItself)
{
  const auto optimizer = make_hasty(false, false, false);
  Silent observer;
  double inner = 0.0;
  MeetingProblem problem([&] {
    Parabola plain(false);
    inner = optimizer->minimize(plain, std::array{0.5}, observer).value;
  });
  EXPECT_EQ(optimizer->minimize(problem, std::array{1.5}, observer).value, 2.25);
  EXPECT_EQ(inner, 0.25);
}

}  // namespace
}  // namespace hauberk::test
