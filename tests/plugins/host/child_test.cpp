#include <hauberk/host/child.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace hauberk::test {
namespace {

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
  EXPECT_EQ(in_child([]() -> std::string { throw std::runtime_error("no licence"); }, 20.0).ending,
            "ended by signal 6 (Aborted); it last printed:   what():  no licence");
}

TEST(InChild, CountsProcessorTime)
{
  const auto busy = []() -> std::string {
    std::atomic<bool> forever{true};
    while (forever.load()) {
    }
    return "never";
  };
  const Child computes = in_child(busy, TimeLimits{.processor = 0.2, .elapsed = 60.0});
  EXPECT_TRUE(computes.out_of_time);
  EXPECT_EQ(computes.ending, "did not return within 0.2 s of processor time");
  EXPECT_GE(computes.processor_seconds, 0.2);
  // What sleeps uses none.
  const auto sleep = []() -> std::string {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return "slept";
  };
  const Child sleeps = in_child(sleep, TimeLimits{.processor = 0.2, .elapsed = 60.0});
  EXPECT_EQ(sleeps.text, "slept");
  EXPECT_FALSE(sleeps.out_of_time);
  EXPECT_LT(sleeps.processor_seconds, 0.2);
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

}  // namespace
}  // namespace hauberk::test
