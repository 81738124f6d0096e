/// How many processors a run takes that is not told, and the memory that it may use.

#include "run/machine.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>

#include <sched.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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

TEST(Memory, OfAGroupIsTheLeastOfAllAboveIt)
{
  const TemporaryFolder folder;
  const std::filesystem::path root = folder.path();
  std::filesystem::create_directories(root / "job/step/task");
  const auto limit = [&](const char* group, const char* text) {
    std::ofstream(root / group / "memory.max") << text << '\n';
  };
  EXPECT_FALSE(memory_of_groups(root, "/job/step/task"));
  limit("job/step/task", "max");
  EXPECT_FALSE(memory_of_groups(root, "/job/step/task"));
  limit("job", "2000000000");
  EXPECT_EQ(memory_of_groups(root, "/job/step/task"), 2e9);
  limit("job/step", "1073741824");
  EXPECT_EQ(memory_of_groups(root, "/job/step/task"), 1073741824.0);
  EXPECT_EQ(memory_of_groups(root, "/job"), 2e9);
  limit("job/step/task", "0x10");
  EXPECT_EQ(memory_of_groups(root, "/job/step/task"), 1073741824.0);
  EXPECT_GT(available_memory(), 0.0);
}

}  // namespace
}  // namespace hauberk::test
