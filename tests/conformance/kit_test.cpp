/// The parts of the kit: differences, child processes, the choice of checks.

#include "differences.hpp"

#include <hauberk/conformance/isolated.hpp>
#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <thread>

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

TEST(InChild, BringsBackWhatTheFunctionReturns)
{
  const std::string large(300000, 'x');
  const Child child = in_child([&] { return "a\n" + large; }, 20.0);
  EXPECT_TRUE(child.returned);
  EXPECT_EQ(child.text, "a\n" + large);
}

TEST(InChild, SurvivesWhateverHappens)
{
  EXPECT_EQ(in_child([]() -> std::string { std::raise(SIGSEGV), std::abort(); }, 20.0).ending,
            "ended by signal 11 (Segmentation fault)");
  const Child aborted = in_child(
      []() -> std::string {
        std::fputs("first\nterminate called\n", stderr);
        std::abort();
      },
      20.0);
  EXPECT_FALSE(aborted.returned);
  EXPECT_EQ(aborted.ending, "ended by signal 6 (Aborted); it last printed: terminate called");
  EXPECT_EQ(in_child([]() -> std::string { std::_Exit(3); }, 20.0).ending,
            "ended the process with exit code 3");
  EXPECT_EQ(in_child([]() -> std::string { std::_Exit(0); }, 20.0).ending,
            "ended the process with exit code 0");
  EXPECT_EQ(in_child([]() -> std::string { throw 1; }, 20.0).ending, "ended the process with exit code 1");
}

TEST(InChild, EndsWhatDoesNotReturn)
{
  const auto forever = []() -> std::string {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  EXPECT_EQ(in_child(forever, 0.2).ending, "did not return within 0.2 s");
  // Printing without end fills no pipe.
  const auto chatty = []() -> std::string {
    for (;;) std::puts("and on");
  };
  EXPECT_EQ(in_child(chatty, 0.2).ending, "did not return within 0.2 s");
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

}  // namespace
}  // namespace hauberk::conformance
