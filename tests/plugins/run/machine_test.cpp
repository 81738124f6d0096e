/// How many processors a run takes that is not told.

#include "run/machine.hpp"

#include <gtest/gtest.h>

#include <sched.h>
#include <cstdlib>
#include <thread>

namespace hauberk::test {
namespace {

TEST(Processors, OfAQuotaAreRoundedUp)
{
  EXPECT_EQ(processors_of_quota("200000 100000"), 2U);
  EXPECT_EQ(processors_of_quota("210000 100000"), 3U);
  EXPECT_EQ(processors_of_quota("5000 100000"), 1U);
  for (const char* none : {"max 100000", "-1 100000", "", "200000", "a b", "1 0"})
    EXPECT_FALSE(processors_of_quota(none)) << none;
}

TEST(Processors, AreThoseOfTheAffinity)
{
  // Of a thread of its own, so that the others keep theirs.
  std::thread([] {
    cpu_set_t all, one;
    ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    for (int k = 0; k < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++k)
      if (CPU_ISSET(k, &all)) CPU_SET(k, &one);
    ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(available_processors(), 1U);
  }).join();
}

TEST(Processors, AreNoMoreThanTheSchedulerSays)
{
  const unsigned all = available_processors();
  ::setenv("SLURM_CPUS_PER_TASK", "1", 1);
  EXPECT_EQ(available_processors(), 1U);
  for (const char* no_limit : {"1000000", "0", "two", ""}) {
    ::setenv("SLURM_CPUS_PER_TASK", no_limit, 1);
    EXPECT_EQ(available_processors(), all) << no_limit;
  }
  ::unsetenv("SLURM_CPUS_PER_TASK");
}

}  // namespace
}  // namespace hauberk::test
