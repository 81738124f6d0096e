/// How many processors a run takes that is not told, and the memory that it may use.

#include "run/machine.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>

#include <sched.h>
#include <sys/resource.h>
#include <cstdlib>
#include <string>
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

TEST(Processors, OfGroupsAreTheFewestOfAllAboveThem)
{
  const TemporaryFolder root;
  const std::string second = "0::/job/step\n", first = "5:cpu,cpuacct:/slurm/job\n" + second;
  const auto write = [&](const std::string& group, const char* file, const char* text) {
    root.folder(group);
    root.file(group + "/" + file, std::string(text) + "\n");
  };
  EXPECT_FALSE(processors_of_groups(root.path(), first));
  write("job/step", "cpu.max", "800000 100000");
  EXPECT_EQ(processors_of_groups(root.path(), second), 8U);
  write("job", "cpu.max", "600000 100000");
  EXPECT_EQ(processors_of_groups(root.path(), second), 6U);
  write("cpu/slurm/job", "cpu.cfs_quota_us", "-1");
  write("cpu/slurm/job", "cpu.cfs_period_us", "100000");
  EXPECT_EQ(processors_of_groups(root.path(), first), 6U);
  write("cpu/slurm", "cpu.cfs_quota_us", "300000");
  write("cpu/slurm", "cpu.cfs_period_us", "100000");
  EXPECT_EQ(processors_of_groups(root.path(), first), 3U);
  EXPECT_EQ(processors_of_groups(root.path(), second), 6U);
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

TEST(Memory, OfGroupsIsTheLeastOfAllAboveThem)
{
  const TemporaryFolder root;
  const std::string second = "1:name=systemd:/else\n0::/job/step/task\n",
                    first = "5:cpu,cpuacct:/else\n4:memory:/slurm/job\n" + second;
  const auto limit = [&](const std::string& group, const char* file, const char* text) {
    root.folder(group);
    root.file(group + "/" + file, std::string(text) + "\n");
  };
  EXPECT_FALSE(memory_of_groups(root.path(), second));
  limit("job/step/task", "memory.max", "max");
  limit("else", "memory.max", "1");
  EXPECT_FALSE(memory_of_groups(root.path(), second));
  limit("job", "memory.max", "2000000000");
  EXPECT_EQ(memory_of_groups(root.path(), second), 2e9);
  limit("job/step", "memory.max", "1073741824");
  EXPECT_EQ(memory_of_groups(root.path(), second), 1073741824.0);
  EXPECT_EQ(memory_of_groups(root.path(), "0::/job\n"), 2e9);
  limit("job/step/task", "memory.max", "0x10");
  EXPECT_EQ(memory_of_groups(root.path(), second), 1073741824.0);
  limit("memory/slurm/job", "memory.limit_in_bytes", "9223372036854771712");
  EXPECT_EQ(memory_of_groups(root.path(), first), 1073741824.0);
  limit("memory/slurm", "memory.limit_in_bytes", "1000000000");
  EXPECT_EQ(memory_of_groups(root.path(), first), 1e9);
  EXPECT_EQ(memory_of_groups(root.path(), second), 1073741824.0);
  limit("unified/job", "memory.max", "500000000");
  EXPECT_EQ(memory_of_groups(root.path(), first), 5e8);
}

TEST(Memory, IsNoMoreThanTheAddressSpaceMayHold)
{
  rlimit former{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &former), 0);
  const double before = available_memory();
  const rlim_t less = static_cast<rlim_t>(before / 2.0);
  const rlimit half{less, former.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &half), 0);
  EXPECT_EQ(available_memory(), static_cast<double>(less));
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &former), 0);
  EXPECT_EQ(available_memory(), before);
}

}  // namespace
}  // namespace hauberk::test
